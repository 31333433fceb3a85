// Tests of the glTF writer: the container, the JSON and the numbers of its accessors, read here by hand. The
// Khronos validator judges the rest in tests/validators.
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "unit/io/scenes.h"

using namespace frep;
using namespace frep::test;
using nlohmann::json;

namespace {

struct Glb {
    json document;
    std::string binary;
};

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    REQUIRE(at + 4 <= bytes.size());
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

Glb parsed(const std::string& bytes) {
    REQUIRE(bytes.size() >= 20);
    CHECK(bytes.substr(0, 4) == "glTF");
    CHECK(word_at(bytes, 4) == 2);
    CHECK(word_at(bytes, 8) == bytes.size());
    const std::size_t length = word_at(bytes, 12);
    CHECK(bytes.substr(16, 4) == "JSON");
    CHECK(length % 4 == 0);
    Glb glb{json::parse(bytes.substr(20, length)), ""};
    if (bytes.size() == 20 + length) return glb;
    CHECK(word_at(bytes, 20 + length) == bytes.size() - 28 - length);
    CHECK(bytes.substr(24 + length, 4) == std::string("BIN\0", 4));
    glb.binary = bytes.substr(28 + length);
    return glb;
}

template <class T>
std::vector<T> numbers(const Glb& glb, std::size_t accessor, std::size_t width) {
    const json& a = glb.document["accessors"][accessor];
    const json& view = glb.document["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t at = view["byteOffset"], count = a["count"].get<std::size_t>() * width;
    CHECK(at % 4 == 0);
    CHECK(view["byteLength"] == count * sizeof(T));
    REQUIRE(at + count * sizeof(T) <= glb.binary.size());
    std::vector<T> values(count);
    std::memcpy(values.data(), glb.binary.data() + at, count * sizeof(T));
    return values;
}

}  // namespace

TEST_CASE("GLB: metres with Y up, linear colors, a node and a material an object") {
    const Glb glb = parsed(encoded(two_tetrahedra(), MeshFormat::glb));
    const json& d = glb.document;
    CHECK(d["asset"]["version"] == "2.0");
    CHECK(d["asset"]["copyright"] == "\xc3\x84, CC0");
    CHECK(d["asset"]["extras"]["title"] == "T<1> ");
    CHECK(d["asset"]["extras"]["source"] == "a & b");
    REQUIRE(d["nodes"].size() == 2);
    CHECK(d["nodes"][0]["name"] == "a<b>&\"c\"");
    CHECK(d["buffers"][0]["byteLength"] == glb.binary.size());

    const json& first = d["meshes"][0]["primitives"][0];
    CHECK(numbers<std::uint32_t>(glb, first["indices"], 1) ==
          std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
    const json& where = first["attributes"]["POSITION"];
    CHECK(numbers<float>(glb, where, 3) ==
          std::vector<float>{0, 0, 0, 0.001f, 0, 0, 0, 0, -0.001f, 0, 0.001f, 0});
    CHECK(numbers<std::uint16_t>(glb, first["attributes"]["COLOR_0"], 4) ==
          std::vector<std::uint16_t>{65535, 0, 0, 65535, 0, 65535, 0, 65535,  //
                                     0, 0, 65535, 65535, 65535, 65535, 65535, 65535});
    CHECK_FALSE(first["attributes"].contains("NORMAL"));
    const json& box = d["accessors"][where.get<std::size_t>()];
    // Exactly the binary32 numbers that are written.
    CHECK(box["max"][0].get<double>() == double{0.001f});
    CHECK(box["min"][2].get<double>() == double{-0.001f});
    CHECK(box["max"][2].get<double>() == 0);

    const json& second = d["meshes"][1]["primitives"][0];
    CHECK(numbers<float>(glb, second["attributes"]["NORMAL"], 3) ==
          std::vector<float>{-1, 0, 0, 1, 0, 0, 0, 0, -1, 0, 1, 0});  // (0, 0, 2) has length 1
    const json& gold = d["materials"][1];
    CHECK(gold["pbrMetallicRoughness"]["metallicFactor"] == 1);
    CHECK(gold["pbrMetallicRoughness"]["roughnessFactor"] == 0.25);
    // sRGB 0.5 is 0.21404 in linear light (IEC 61966-2-1).
    CHECK(gold["pbrMetallicRoughness"]["baseColorFactor"][1].get<double>() ==
          doctest::Approx(0.21404).epsilon(1e-4));
    CHECK(gold["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"] == 1);
    CHECK(d["extensionsUsed"] == json{"KHR_materials_clearcoat"});
    CHECK_FALSE(d["materials"][0].contains("extensions"));
}

TEST_CASE("GLB: the unit scales, unused vertices and collapsed triangles go") {
    Scene scene;
    scene.unit = *length_unit("inch");
    Mesh mesh = tetrahedron();
    mesh.vertices.insert(mesh.vertices.begin(), Vec3{100, 100, 100});
    for (Triangle& t : mesh.triangles) t = {t[0] + 1, t[1] + 1, t[2] + 1};
    mesh.triangles.push_back({1, 1, 2});
    scene.objects.push_back({"", mesh, {}});
    const Glb glb = parsed(encoded(scene, MeshFormat::glb));
    CHECK(glb.document["accessors"][0]["count"] == 12);
    CHECK(glb.document["accessors"][1]["count"] == 4);
    CHECK(glb.document["accessors"][1]["max"][0].get<double>() == double{0.0254f});
    CHECK_FALSE(glb.document["nodes"][0].contains("name"));
}

TEST_CASE("GLB: normals without direction are replaced, colors without value are black") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Scene scene;
    Mesh mesh = tetrahedron();
    mesh.triangles.resize(1);  // looks down: normal (0, 0, -1), with Y up (0, -1, 0)
    mesh.normals = {{0, 0, 0}, {nan, 0, 0}, {0, 0, 5}, {0, 0, 0}};
    mesh.colors.assign(4, {nan, 2, -1});
    scene.objects.push_back({"", mesh, {}});
    const Glb glb = parsed(encoded(scene, MeshFormat::glb));
    const json& attributes = glb.document["meshes"][0]["primitives"][0]["attributes"];
    CHECK(numbers<float>(glb, attributes["NORMAL"], 3) == std::vector<float>{0, -1, 0, 0, -1, 0, 0, 1, 0});
    const auto colors = numbers<std::uint16_t>(glb, attributes["COLOR_0"], 4);
    CHECK(colors[0] == 0);
    CHECK(colors[1] == 65535);
    CHECK(colors[2] == 0);
}

TEST_CASE("GLB: a scene without triangles has no meshes and no binary chunk") {
    for (const bool with_object : {false, true}) {
        Scene scene;
        if (with_object) scene.objects.push_back({"empty", {}, {}});
        const Glb glb = parsed(encoded(scene, MeshFormat::glb));
        CHECK(glb.binary.empty());
        CHECK(glb.document ==
              json::parse(R"({"asset":{"version":"2.0","generator":"frep"},"scene":0,"scenes":[{}]})"));
    }
}
