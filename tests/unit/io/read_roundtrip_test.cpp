// What a writer writes, the reader of that format reads back: coordinates equal in binary32 (in binary64 for
// OFF), triangles, normals, colors to 1/255, objects and materials where the format keeps them. And files
// damaged in thousands of ways end with a valid scene or an error, in bounded memory.
#include <string>

#include "frep/io/mesh_format.h"
#include "unit/geom/shapes.h"
#include "unit/io/read_test.h"

using namespace frep;
using namespace frep::test;

namespace {

struct Pair {
    MeshFormat written;
    SceneReadFormat read;
    bool ascii;
};
const std::vector<Pair> pairs{
    {MeshFormat::off, SceneReadFormat::off, false},  {MeshFormat::ply, SceneReadFormat::ply, false},
    {MeshFormat::ply, SceneReadFormat::ply, true},   {MeshFormat::stl, SceneReadFormat::stl, false},
    {MeshFormat::stl, SceneReadFormat::stl, true},   {MeshFormat::obj, SceneReadFormat::obj, false},
    {MeshFormat::glb, SceneReadFormat::gltf, false},
};

/// A torus of 12 x 7 vertices at places that need all digits, with normals and colors.
Scene torus() {
    Scene scene;
    scene.unit = {"m", 1};  // so that GLB scales nothing
    SceneObject object;
    object.name = "ring";
    object.mesh = grid_torus(12, 7);
    object.mesh.colors.clear();
    for (std::size_t i = 0; i < object.mesh.vertices.size(); ++i) {
        Vec3& v = object.mesh.vertices[i];
        v = {v.x / 3 - 1, v.y * -7.1, v.z / 7e5};
        const auto byte = [i](std::size_t k) { return static_cast<double>((i * k) % 256) / 255; };
        object.mesh.colors.push_back({byte(3), byte(7), byte(31)});
        object.mesh.normals.push_back(i % 2 ? Vec3{0, 0.6, -0.8} : Vec3{0, 0, 1});
    }
    object.material.base = {1, 1, 1};
    scene.objects.push_back(object);
    return scene;
}

std::string written(const Scene& scene, const Pair& pair) {
    auto files = encode_scene(scene, pair.written, {.ascii = pair.ascii});
    REQUIRE(bool(files));
    return files->bytes;
}

bool same_float(const Vec3& a, const Vec3& b) {
    const auto f = [](double v) { return static_cast<float>(v); };
    return f(a.x) == f(b.x) && f(a.y) == f(b.y) && f(a.z) == f(b.z);
}

/// Deterministic random numbers (Marsaglia 2003).
struct Xorshift {
    std::uint64_t state;
    std::uint64_t next() {
        state ^= state << 13;
        state ^= state >> 7;
        return state ^= state << 17;
    }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }
};

std::string damaged(std::string bytes, Xorshift& random) {
    for (std::size_t change = random.below(4) + 1; change > 0 && !bytes.empty(); --change) {
        const std::size_t at = random.below(bytes.size());
        const std::size_t length = std::min(bytes.size() - at, random.below(40) + 1);
        switch (random.below(7)) {
            case 0:
                bytes[at] = static_cast<char>(random.next());
                break;
            case 1:
                bytes[at] =
                    static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1u << random.below(8)));
                break;
            case 2:
                bytes.resize(at);
                break;
            case 3:
                bytes.insert(random.below(bytes.size()), bytes.substr(at, length));
                break;
            case 4:
                bytes.erase(at, length);
                break;
            case 5:  // a count of 4 bytes
                for (std::size_t i = at; i < bytes.size() && i < at + 4; ++i) bytes[i] = '\xff';
                break;
            default:  // a number in text
                if (bytes[at] >= '0' && bytes[at] <= '9')
                    bytes.replace(at, 1, random.below(2) ? "4294967295" : "-9");
        }
    }
    return bytes;
}

/// Decodes and checks what every file must keep to; true for a scene.
bool survives(const std::string& bytes, SceneReadFormat format) {
    constexpr std::size_t instances = 5000;
    const auto scene = decode_scene(bytes, format, {.read_companion = {}, .instance_limit = instances});
    if (!scene) {
        CHECK_FALSE(scene.error().message.empty());
        return false;
    }
    std::size_t vertices = 0, triangles = 0;
    for (const SceneObject& object : scene->objects) {
        CHECK(is_valid(object.mesh));
        for (const Vec3& v : object.mesh.vertices) CHECK(near(v, v, 0));  // finite
        vertices += object.mesh.vertices.size();
        triangles += object.mesh.triangles.size();
    }
    const std::size_t limit = bytes.size() + (format == SceneReadFormat::gltf ? instances : 0);
    CHECK(vertices <= limit);
    CHECK(triangles <= limit);
    return true;
}

}  // namespace

TEST_CASE("round trips: what is written is read back") {
    const Scene scene = torus();
    const Mesh& before = scene.objects[0].mesh;
    for (const Pair& pair : pairs) {
        CAPTURE(static_cast<int>(pair.written));
        CAPTURE(pair.ascii);
        const std::string bytes = written(scene, pair);
        CHECK(*scene_read_format("no extension", bytes) == pair.read);
        const Decoded all = decoded(bytes, pair.read, {.unit = {"m", 1}, .read_companion = {}});
        REQUIRE(all.scene.objects.size() == 1);
        const Mesh& after = all.scene.objects[0].mesh;
        if (pair.written == MeshFormat::stl) {  // vertices in the order of the triangles
            REQUIRE(after.triangles.size() == before.triangles.size());
            for (std::size_t t = 0; t < after.triangles.size(); ++t)
                for (std::size_t k = 0; k < 3; ++k)
                    CHECK(same_float(after.vertices[after.triangles[t][k]],
                                     before.vertices[before.triangles[t][k]]));
            CHECK(after.vertices.size() == before.vertices.size());
            continue;
        }
        CHECK(after.triangles == before.triangles);
        REQUIRE(after.vertices.size() == before.vertices.size());
        REQUIRE(after.colors.size() == before.colors.size());
        for (std::size_t i = 0; i < after.vertices.size(); ++i) {
            CHECK(same_float(after.vertices[i], before.vertices[i]));
            if (pair.written == MeshFormat::off) CHECK(near(after.vertices[i], before.vertices[i]));
            const Color a = after.colors[i], b = before.colors[i];
            CHECK(near({a.r, a.g, a.b}, {b.r, b.g, b.b}, pair.written == MeshFormat::ply ? 0 : 1.0 / 255));
        }
        if (pair.written == MeshFormat::off) continue;
        REQUIRE(after.normals.size() == before.normals.size());
        CHECK(near(after.normals[1], before.normals[1], 1e-6));
    }
}

TEST_CASE("round trips: objects and materials of OBJ and GLB") {
    Scene scene;
    scene.unit = {"m", 1};
    for (int i = 0; i < 2; ++i) {
        SceneObject object;
        object.name = i == 0 ? "pot" : "lid";
        object.mesh = tetrahedron({2.0 * i, 0, 0});
        object.material.base = i == 0 ? Color{0.55, 0.04, 0.03} : Color{0.1, 0.9, 0.5};
        object.material.roughness = 0.25;
        scene.objects.push_back(object);
    }
    const auto files = encode_scene(scene, MeshFormat::obj, {.stem = "pot"});
    REQUIRE(bool(files));
    REQUIRE(files->side_files.size() == 1);
    ReadOptions options{.unit = {"m", 1}, .read_companion = {}};
    options.read_companion = [&](std::string_view name) -> Result<std::string> {
        CHECK(name == files->side_files[0].name);
        return files->side_files[0].bytes;
    };
    for (const bool is_glb : {false, true}) {
        const std::string bytes =
            is_glb ? written(scene, {MeshFormat::glb, SceneReadFormat::gltf, false}) : files->bytes;
        const Scene after =
            decoded(bytes, is_glb ? SceneReadFormat::gltf : SceneReadFormat::obj, options).scene;
        REQUIRE(after.objects.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(after.objects[i].name == scene.objects[i].name);
            CHECK(after.objects[i].mesh.triangles == scene.objects[i].mesh.triangles);
            CHECK(near(after.objects[i].mesh.vertices[1], scene.objects[i].mesh.vertices[1]));
            CHECK(after.objects[i].material.base.g ==
                  doctest::Approx(scene.objects[i].material.base.g).epsilon(0.005));
            if (is_glb) CHECK(after.objects[i].material.roughness == doctest::Approx(0.25));
        }
    }
}

TEST_CASE("round trips: millimetres through the metres of GLB") {
    Scene scene = torus();
    scene.unit = {"mm", 0.001};
    const Scene after =
        decoded(written(scene, {MeshFormat::glb, SceneReadFormat::gltf, false}), SceneReadFormat::gltf).scene;
    CHECK(near(after.objects.at(0).mesh.vertices.at(40), scene.objects[0].mesh.vertices[40], 1e-5));
}

TEST_CASE("files cut anywhere end with a scene or an error") {
    Scene scene;
    scene.objects.push_back({"t", tetrahedron(), {}});
    for (const Pair& pair : pairs) {
        const std::string bytes = written(scene, pair);
        for (std::size_t size = 0; size <= bytes.size(); ++size) survives(bytes.substr(0, size), pair.read);
    }
}

TEST_CASE("damaged files end with a scene or an error, in bounded memory") {
    Scene scene = torus();
    scene.objects[0].mesh = tetrahedron();
    scene.objects[0].mesh.colors.assign(4, {0.2, 0.4, 0.6});
    Xorshift random{0x9e3779b97f4a7c15u};
    std::size_t scenes = 0, files = 0;
    for (const Pair& pair : pairs) {
        const std::string bytes = written(scene, pair);
        for (int i = 0; i < 720; ++i, ++files) scenes += survives(damaged(bytes, random), pair.read);
    }
    CHECK(files >= 5000);
    CHECK(scenes > 100);          // some damage is harmless
    CHECK(scenes < files - 100);  // and some is not
}
