// Uses an installed frep as a stranger would: compiles a model, meshes it, checks and writes the mesh.
#include <cstdio>

#include <frep/frep.h>

int main() {
    const auto model =
        frep::compile("my_model(x[3], a[1])\n{\n  my_model = 4 - x[1]^2 - x[2]^2 - x[3]^2;\n}\n");
    if (!model) return std::fputs(model.error().message.c_str(), stderr), 1;
    const auto field = model->field();
    if (!field) return std::fputs(field.error().message.c_str(), stderr), 1;
    const auto result =
        frep::contour(*field, {.bounds = frep::Box3::cube(3), .cells = 16, .tolerance = 0.01});
    if (!result) return std::fputs(result.error().message.c_str(), stderr), 1;
    const frep::MeshReport report = frep::check(result->mesh);
    std::printf("%zu triangles, closed: %d\n", report.triangles, report.closed);
    if (!report.closed || !report.manifold || !report.oriented) return 1;
    return frep::write("ball.stl", result->mesh) ? 0 : 1;
}
