// Tests of the 3MF writer: the parts of the package and the model, unpacked by tests/unit/io/unzip.h. lib3mf
// reads the files in tests/validators.
#include "unit/io/scenes.h"
#include "unit/io/unzip.h"

using namespace frep;
using namespace frep::test;

namespace {

std::string model(const Scene& scene) {
    const std::vector<Unzipped> parts = unzip(encoded(scene, MeshFormat::threemf));
    REQUIRE(parts.size() == 3);
    CHECK(parts[0].name == "[Content_Types].xml");
    CHECK(parts[1].name == "_rels/.rels");
    CHECK(parts[2].name == "3D/3dmodel.model");
    CHECK(contains(parts[1].bytes, "Target=\"/3D/3dmodel.model\""));
    return parts[2].bytes;
}

}  // namespace

TEST_CASE("3MF: objects, colors, metadata") {
    const std::string text = model(two_tetrahedra());
    CHECK(contains(text, "<model unit=\"millimeter\" "));
    CHECK(contains(text, "<metadata name=\"Title\">T&lt;1&gt; </metadata>"));
    CHECK(contains(text, "<metadata name=\"Designer\">\xc3\x84</metadata>"));
    CHECK(contains(text, "<metadata name=\"LicenseTerms\">CC0</metadata>"));
    // Colors sorted: blue, green, red, white.
    CHECK(
        contains(text,
                 "<m:colorgroup id=\"1\">\n   <m:color color=\"#0000FF\"/>\n   <m:color color=\"#00FF00\"/>\n"
                 "   <m:color color=\"#FF0000\"/>\n   <m:color color=\"#FFFFFF\"/>\n"));
    CHECK(contains(
        text,
        "<object id=\"2\" name=\"a&lt;b&gt;&amp;&quot;c&quot;\" type=\"model\" pid=\"1\" pindex=\"0\">"));
    CHECK(contains(text, "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"1\" p1=\"2\" p2=\"0\" p3=\"1\"/>"));
    CHECK(contains(
        text,
        "<basematerials id=\"3\"><base name=\"a&lt;b&gt;&amp;&quot;c&quot;\" displaycolor=\"#FF8000\"/>"));
    CHECK(contains(text, "<item objectid=\"2\"/>\n  <item objectid=\"4\"/>"));
    CHECK(count_of(text, "<vertex ") == 8);
}

TEST_CASE("3MF: equal positions are joined, collapsed triangles dropped, open meshes are surfaces") {
    Scene scene;
    Mesh soup;  // every triangle with vertices of its own, and one without area
    const Mesh tetra = tetrahedron();
    for (const Triangle& t : tetra.triangles) {
        const auto base = static_cast<std::uint32_t>(soup.vertices.size());
        for (const std::uint32_t v : t) soup.vertices.push_back(tetra.vertices[v]);
        soup.triangles.push_back({base, base + 1, base + 2});
    }
    soup.vertices[0].x = -0.0;
    soup.triangles.push_back({0, 3, 1});
    scene.objects.push_back({"", soup, {}});
    const std::string closed = model(scene);
    CHECK(count_of(closed, "<vertex ") == 4);
    CHECK(count_of(closed, "<triangle ") == 4);
    CHECK(contains(closed, "type=\"model\""));
    CHECK_FALSE(contains(closed, "\"-0\""));
    scene.objects[0].mesh.triangles.pop_back();
    scene.objects[0].mesh.triangles.pop_back();
    CHECK(contains(model(scene), "type=\"surface\""));
    // Closed, but one triangle looks the wrong way.
    scene.objects[0].mesh = tetra;
    std::swap(scene.objects[0].mesh.triangles[0][0], scene.objects[0].mesh.triangles[0][1]);
    CHECK(contains(model(scene), "type=\"surface\""));
}

TEST_CASE("3MF: units") {
    Scene scene;
    scene.objects.push_back({"", tetrahedron(), {}});
    const std::pair<const char*, const char*> names[] = {{"um", "micron"},     {"mm", "millimeter"},
                                                         {"cm", "centimeter"}, {"inch", "inch"},
                                                         {"ft", "foot"},       {"m", "meter"}};
    for (const auto& name : names) {
        scene.unit = *length_unit(name.first);
        const std::string text = model(scene);
        CHECK(contains(text, std::string("unit=\"") + name.second + "\""));
        CHECK(contains(text, "x=\"1\""));
    }
    scene.unit = {"yard", 0.9144};  // the format has no yard
    const std::string text = model(scene);
    CHECK(contains(text, "unit=\"millimeter\""));
    CHECK(contains(text, "x=\"914.4\""));
}

TEST_CASE("3MF: a scene without triangles builds nothing") {
    Scene scene;
    scene.objects.push_back({"empty", {}, {}});
    CHECK(contains(model(scene), " <resources>\n </resources>\n <build>\n </build>\n</model>\n"));
}
