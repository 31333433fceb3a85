// Tests of reading glTF (io/read_gltf.cpp, read_gltf_data.cpp, read_json.cpp): containers, accessors,
// transforms, materials, refusals.
#include "frep/io/read_gltf_data.h"
#include "unit/io/read_test.h"

using namespace frep;
using namespace frep::test;

namespace {

constexpr SceneReadFormat gltf = SceneReadFormat::gltf;

const ReadOptions in_metres{.unit = {"m", 1}, .read_companion = {}};

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        const std::size_t n = bytes.size() - i < 3 ? bytes.size() - i : 3;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) out += k <= n ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

/// A .gltf file: `more` holds the members besides asset and buffers.
std::string file(const std::string& more, std::string_view buffer) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(buffer.size()) +
           R"(,"uri":"data:application/octet-stream;base64,)" + base64(buffer) + "\"}]," + more + "}";
}

std::string glb(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    Bytes bytes;
    bytes.text("glTF").add(2u).add(static_cast<std::uint32_t>(28 + json.size() + binary.size()));
    bytes.add(static_cast<std::uint32_t>(json.size())).text("JSON").text(json);
    bytes.add(static_cast<std::uint32_t>(binary.size())).text(std::string_view("BIN\0", 4)).text(binary);
    return bytes.out;
}

/// Three corners (1,2,3) (4,2,3) (1,5,3), binary32, 16 bytes apart; then the indices 2 0 1 as 16 bits.
std::string corners() {
    Bytes bytes;
    for (const std::array<float, 4> p :
         {std::array{1.f, 2.f, 3.f, 9.f}, {4.f, 2.f, 3.f, 9.f}, {1.f, 5.f, 3.f, 9.f}})
        for (const float value : p) bytes.add(value);
    for (const std::uint16_t i : {2, 0, 1}) bytes.add(i);
    return bytes.out;
}
constexpr const char* views =
    R"("bufferViews":[{"buffer":0,"byteLength":48,"byteStride":16},{"buffer":0,"byteOffset":48,"byteLength":6}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
    R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}])";
constexpr const char* mesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";

std::string nodes(const std::string& list) {
    return std::string(views) + "," + mesh + R"(,"scenes":[{"nodes":[0]}],"scene":0,"nodes":[)" + list + "]";
}

}  // namespace

TEST_CASE("glTF: strides and indices; metres and Y up become the unit and Z up") {
    const std::string bytes = file(nodes(R"({"mesh":0,"name":"tri"})"), corners());
    const Decoded metres = decoded(bytes, gltf, in_metres);
    REQUIRE(metres.scene.objects.size() == 1);
    const Mesh& m = metres.scene.objects[0].mesh;
    CHECK(metres.scene.objects[0].name == "tri");
    CHECK(near(m.vertices.at(0), {1, -3, 2}));
    CHECK(near(m.vertices.at(1), {4, -3, 2}));
    CHECK(near(m.vertices.at(2), {1, -3, 5}));
    CHECK(m.triangles == std::vector<Triangle>{{2, 0, 1}});
    CHECK(metres.report.unit_stated);
    CHECK(near(only_mesh(bytes, gltf).vertices.at(1), {4000, -3000, 2000}));  // millimetres by default
}

TEST_CASE("glTF: the same in a GLB; a chunk that is not known is read over") {
    const std::string json =
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":54}],)" + nodes(R"({"mesh":0})") + "}";
    std::string bytes = glb(json, corners());
    CHECK(near(decoded(bytes, gltf, in_metres).scene.objects.at(0).mesh.vertices.at(2), {1, -3, 5}));
    CHECK(*scene_read_format("whatever.stl", bytes) == gltf);
    bytes += std::string("\4\0\0\0ABCDwxyz", 12);
    bytes[8] = static_cast<char>(static_cast<unsigned char>(bytes[8]) + 12);
    CHECK(decoded(bytes, gltf).scene.objects.size() == 1);
}

TEST_CASE("glTF: transforms of nodes, and of nodes above them") {
    // 90 degrees about Y up takes x to -z and z to x; then twice the size, then shifted: all under a shift
    const std::string list =
        R"({"children":[1],"translation":[0,10,0]},)"
        R"({"mesh":0,"rotation":[0,0.7071067811865476,0,0.7071067811865476],"scale":[2,2,2],"translation":[100,0,0]})";
    const Mesh m = decoded(file(nodes(list), corners()), gltf, in_metres).scene.objects.at(0).mesh;
    // glTF (1,2,3) -> (6,4,-2) -> (106,14,-2), in Z up (106, 2, 14)
    CHECK(near(m.vertices.at(0), {106, 2, 14}, 1e-9));
    // the same shift as a matrix with a reflection: triangles turn round
    const std::string mirror = R"({"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 7,0,0,1]})";
    const Mesh n = decoded(file(nodes(mirror), corners()), gltf, in_metres).scene.objects.at(0).mesh;
    CHECK(near(n.vertices.at(0), {6, -3, 2}));
    CHECK(n.triangles == std::vector<Triangle>{{2, 1, 0}});
}

TEST_CASE("glTF: normalised colors, materials, strips and fans") {
    Bytes data;
    for (const float v : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) data.add(v);
    for (const int v : {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 0, 0, 0, 0})
        data.add(static_cast<std::uint8_t>(v));
    for (const float v : {0.f, 0.f, 2.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f}) data.add(v);
    const auto with_mode = [&](const std::string& mode) {
        return file(
            R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":16},)"
            R"({"buffer":0,"byteOffset":64,"byteLength":48}],)"
            R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
            R"({"bufferView":1,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"},)"
            R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC3"}],)"
            R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0.21404114048223255,1],"roughnessFactor":0.25},)"
            R"("extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.5}}}],"nodes":[{"mesh":0}],)"
            R"("meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0,"COLOR_0":1,"NORMAL":2},"material":0,"mode":)" +
                mode + "}]}]",
            data.out);
    };
    const SceneObject strip = decoded(with_mode("5"), gltf).scene.objects.at(0);
    CHECK(strip.name == "m");
    CHECK(strip.mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
    CHECK(strip.mesh.colors.at(0).r == doctest::Approx(1));
    CHECK(strip.mesh.colors.at(0).g == 0);
    CHECK(near(strip.mesh.normals.at(0), {0, -1, 0}));
    CHECK(strip.material.base.r == doctest::Approx(1));
    CHECK(strip.material.base.b == doctest::Approx(0.5));  // sRGB of that linear light (IEC 61966-2-1)
    CHECK(strip.material.roughness == 0.25);
    CHECK(strip.material.metallic == 1);
    CHECK(strip.material.clearcoat == 0.5);
    CHECK(decoded(with_mode("6"), gltf).scene.objects.at(0).mesh.triangles ==
          std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}});
    CHECK(decoded(with_mode("1"), gltf).report.dropped.at(0) == "1 primitive of lines or points");
}

TEST_CASE("glTF: refusals name what is wrong") {
    const auto refused = [](const std::string& more) { return refusal(file(more, corners()), gltf); };
    CHECK(refused(R"("extensionsRequired":["KHR_draco_mesh_compression"])") ==
          "the file requires the extension `KHR_draco_mesh_compression`, which is not read");
    std::string sparse = nodes(R"({"mesh":0})");
    sparse.insert(sparse.find("\"count\":3"), "\"sparse\":{},");
    CHECK(refused(sparse) == "accessors[0] is sparse, which is not read");
    std::string many = nodes(R"({"mesh":0})");
    many.replace(many.find("\"count\":3"), 9, "\"count\":4");
    CHECK(refused(many) == "accessors[0]: 4 elements do not fit into its bufferView");
    many.replace(many.find("\"count\":4"), 9, "\"count\":18446744073709551615");
    CHECK(refused(many).find("do not fit") != std::string::npos);
    CHECK(refused(nodes(R"({"mesh":1})")) == "nodes[0].mesh names none of the meshes");
    CHECK(refused(nodes(R"({"children":[0]})")) == "nodes[0] stands in the tree of nodes twice");
    CHECK(refused(nodes(R"({"mesh":0,"scale":[1,2]})")) == "nodes[0].scale is not 3 numbers");
    CHECK(refused(nodes(R"({"mesh":0,"scale":[1e300,1e300,1e308]})")).find("not finite") !=
          std::string::npos);
    CHECK(refusal("{\"asset\":{\"version\":\"1.0\"}}", gltf) == "asset.version is `1.0`; glTF 2.0 is read");
    CHECK(refusal("{\"asset\":}", gltf).find("byte ") == 0);
    CHECK(refusal(std::string(100000, '['), gltf) == "byte 64: JSON is nested more than 64 deep");
    CHECK(refusal(std::string_view("glTF\2\0\0\0", 8), gltf).find("byte 8") == 0);
    CHECK(refusal(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":1,"uri":"../x.bin"}]})", gltf) ==
          "buffers[0] stands in a further file, `../x.bin`, which is not read here");
    std::string beyond = corners();
    beyond[48] = 3;
    CHECK(refusal(file(nodes(R"({"mesh":0})"), beyond), gltf) ==
          "meshes[0].primitives[0]: index 0 names vertex 3; there are 3");
}

TEST_CASE("glTF: a small file cannot ask for a large scene") {
    std::string list = R"({"children":[)";
    std::string leaves;
    for (int i = 1; i <= 1000; ++i) {
        list += std::to_string(i) + (i < 1000 ? "," : "");
        leaves += R"(,{"mesh":0})";
    }
    const std::string bytes = file(nodes(list + "]}" + leaves), corners());
    CHECK(decoded(bytes, gltf).scene.objects.size() == 1000);
    const auto refused = decode_scene(bytes, gltf, {.read_companion = {}, .instance_limit = 0});
    REQUIRE_FALSE(bool(refused));
    CHECK(refused.error().kind == ErrorKind::over_limit);
}

TEST_CASE("base64: the vectors of RFC 4648") {
    using reading::decode_base64;
    CHECK(decode_base64("").value() == "");
    CHECK(decode_base64("Zg==").value() == "f");
    CHECK(decode_base64("Zm8").value() == "fo");
    CHECK(decode_base64("Zm9vYmFy").value() == "foobar");
    CHECK(decode_base64("/+8=").value() == "\xff\xef");
    CHECK_FALSE(decode_base64("Z"));
    CHECK_FALSE(decode_base64("Zm 9"));
}
