// Writes the meshes that the validators judge, in every format, into a folder, and what is expected of each
// in NAME.expect: a line `unit<TAB>METRES`, then for each object with triangles a line
// `object<TAB>NAME<TAB>TRIANGLES<TAB>VOLUME<TAB>COLORED`, with the volume of check() in cubic model units, or
// `-` where the mesh is open. See judge.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "frep/frep.h"
#include "frep/io/encode.h"
#include "frep/io/text.h"

namespace {

using namespace frep;

[[noreturn]] void stop(const std::string& message) {
    std::fprintf(stderr, "write_samples: %s\n", message.c_str());
    std::exit(1);
}

Mesh mesh_of(const char* body, const Box3& bounds) {
    const auto model = compile("my_model(x[3], a[1]) { my_model = " + std::string(body) + "; }");
    if (!model) stop(model.error().message);
    ContourOptions options;
    options.bounds = bounds;
    options.cells = 24;
    auto result = contour(model->field().value(), options);
    if (!result) stop(result.error().message);
    return std::move(result->mesh);
}

/// Colors that follow the position: many different ones, in all three components.
void color(Mesh& mesh, double radius) {
    for (const Vec3& v : mesh.vertices) {
        mesh.colors.push_back({0.5 + 0.5 * v.x / radius, 0.5 + 0.5 * v.y / radius, 0.5 + 0.5 * v.z / radius});
    }
}

struct Sample {
    std::string name;
    Scene scene;
};

Sample sphere() {
    Sample sample{"sphere", {}};
    Mesh mesh = mesh_of("100 - x[1]^2 - x[2]^2 - x[3]^2", Box3::cube(12));
    color(mesh, 12);
    sample.scene.objects.push_back({"sphere", std::move(mesh), {{1, 1, 1}, 0, 0.4, 0}});
    sample.scene.title = "A sphere";
    sample.scene.author = "frep";
    sample.scene.license = "CC0-1.0";
    sample.scene.source = "tests/validators";
    return sample;
}

Sample torus() {
    Sample sample{"torus", {}};
    Mesh mesh = mesh_of("0.25 - (sqrt(x[1]^2 + x[2]^2) - 1)^2 - x[3]^2", Box3::cube(1.7));
    sample.scene.objects.push_back({"", std::move(mesh), {{0.8, 0.6, 0.2}, 1, 0.25, 0}});
    sample.scene.unit = *length_unit("inch");
    return sample;
}

/// Two objects with names that every syntax has to escape, and degenerate normals.
Sample named() {
    Sample sample{"named", {}};
    const std::string name = "<b>&\"it's\" \\ #1 \xe6\xbc\x86\xe5\x99\xa8\t\x01 \xc3\xa4]]>{}%";
    Mesh plain = mesh_of("4 - x[1]^2 - x[2]^2 - x[3]^2", Box3::cube(3));
    plain.normals[0] = {0, 0, 0};
    plain.triangles.push_back({0, 0, 1});
    Mesh colored = mesh_of("1 - (x[1] - 5)^2 - x[2]^2 - x[3]^4", {{3, -2, -2}, {7, 2, 2}});
    color(colored, 8);
    sample.scene.objects.push_back({name, std::move(plain), {{0.5, 0.03, 0.02}, 0, 0.3, 1}});
    sample.scene.objects.push_back({name, std::move(colored), {{0.9, 0.8, 0.7}, 0.3, 0.6, 0}});
    sample.scene.title = sample.scene.author = sample.scene.license = sample.scene.source = name;
    return sample;
}

Sample open() {
    Sample sample{"open", {}};
    Mesh mesh = mesh_of("100 - x[1]^2 - x[2]^2 - x[3]^2", {{-12, -12, -12}, {12, 12, 3.3}});
    mesh.normals.clear();
    sample.scene.objects.push_back({"bowl", std::move(mesh), {}});
    return sample;
}

Sample empty() {
    Sample sample{"empty", {}};
    sample.scene.title = "Nothing";
    sample.scene.objects.push_back({"nothing", {}, {}});
    return sample;
}

void write_expectation(const std::string& folder, const Sample& sample) {
    std::string text = "unit\t";
    encode::append_number(text, sample.scene.unit.metres);
    text += '\n';
    for (const SceneObject& object : sample.scene.objects) {
        const Mesh merged = merge_equal_positions(object.mesh);
        if (merged.triangles.empty()) continue;
        const MeshReport report = check(object.mesh);
        text += "object\t" + encode::clean_text(object.name) + '\t';
        encode::append_number(text, merged.triangles.size());
        text += '\t';
        if (report.volume) encode::append_number(text, *report.volume);
        if (!report.volume) text += '-';
        text += object.mesh.colors.empty() ? "\t0\n" : "\t1\n";
    }
    if (const Status ok = write_file(folder + "/" + sample.name + ".expect", text); !ok)
        stop(ok.error().message);
}

void write_drawings(const std::string& folder) {
    const Polyline square{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}, true};
    const Polyline hole{{{5, 5}, {5, 7}, {7, 7}, {7, 5}}, true};
    const Polyline open{{{0, 12}, {20, 12}}, false};
    DrawingOptions options;
    options.title = "<b>&\"it's\" \xe6\xbc\x86";
    options.description = "]]> -- &amp;";
    for (const char* extension : {".svg", ".dxf"}) {
        const DrawingFormat format = *drawing_format_from_path(extension);
        const auto drawing = encode_drawing({square, hole, open}, format, options);
        const auto nothing = encode_drawing({}, format, options);
        if (!drawing || !nothing) stop("a drawing is refused");
        if (!write_file(folder + "/drawing" + extension, *drawing) ||
            !write_file(folder + "/nothing" + extension, *nothing))
            stop("a drawing cannot be written");
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) stop("usage: write_samples FOLDER");
    const std::string folder = arguments[1];
    for (const Sample& sample : {sphere(), torus(), named(), open(), empty()}) {
        for (const char* extension :
             {".off", ".ply", ".stl", ".obj", ".glb", ".wrl", ".x3d", ".3mf", ".pov"}) {
            const Status ok = write(folder + "/" + sample.name + extension, sample.scene);
            if (!ok) stop(sample.name + extension + ": " + ok.error().message);
        }
        write_expectation(folder, sample);
    }
    write_drawings(folder);
}
