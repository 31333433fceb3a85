// Tests of the VRML and X3D writers: metres with Y up, names, colors. X3D is parsed by xmllint in
// tests/validators.
#include "unit/io/scenes.h"

using namespace frep;
using namespace frep::test;

TEST_CASE("VRML: groups, names and geometry") {
    const std::string text = encoded(two_tetrahedra(), MeshFormat::vrml);
    CHECK(text.substr(0, 16) == "#VRML V2.0 utf8\n");
    CHECK(contains(text, "WorldInfo {\n title \"T<1> \"\n info [ \"author: \xc3\x84\" \"license: CC0\" "));
    CHECK(contains(text, "DEF a_b_c_ Group { children [\n  WorldInfo { title \"a<b>&\\\"c\\\"\" }\n"));
    CHECK(contains(text, "DEF a_b_c__2 Group"));
    CHECK(contains(text, "point [\n0 0 0,\n0.001 0 0,\n0 0 -0.001,\n0 0.001 0,\n    ] }"));
    CHECK(contains(text, "color [\n1 0 0,\n0 1 0,\n0 0 1,\n1 1 1,\n    ] }"));
    CHECK(contains(text, "vector [\n-1 0 0,\n1 0 0,\n0 0 -1,\n0 1 0,\n    ] }"));
    CHECK(contains(text, "coordIndex [\n0 2 1 -1\n0 1 3 -1\n0 3 2 -1\n1 2 3 -1\n    ]"));
    CHECK(count_of(text, "{") == count_of(text, "}"));
    CHECK(count_of(text, "[") == count_of(text, "]"));
    CHECK(encoded({}, MeshFormat::vrml) == "#VRML V2.0 utf8\n# frep\n");
}

TEST_CASE("X3D: head, groups, names and geometry") {
    const std::string text = encoded(two_tetrahedra(), MeshFormat::x3d);
    CHECK(contains(text, "<X3D profile=\"Interchange\" version=\"3.3\""));
    CHECK(contains(text, "<meta name=\"title\" content=\"T&lt;1&gt; \"/>"));
    CHECK(contains(text, "<meta name=\"reference\" content=\"a &amp; b\"/>"));
    CHECK(contains(text, "<Group DEF=\"a_b_c_\">\n   <WorldInfo title=\"a&lt;b&gt;&amp;&quot;c&quot;\"/>"));
    CHECK(contains(text, "<Group DEF=\"a_b_c__2\">"));
    CHECK(contains(text, "<Coordinate point=\"\n0 0 0\n0.001 0 0\n0 0 -0.001\n0 0.001 0\n\"/>"));
    CHECK(contains(text, "<Color color=\"\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n\"/>"));
    CHECK(contains(text, "<Normal vector=\"\n-1 0 0\n1 0 0\n0 0 -1\n0 1 0\n\"/>"));
    CHECK(contains(text, "coordIndex=\"\n0 2 1 -1\n0 1 3 -1\n0 3 2 -1\n1 2 3 -1\n\""));
    CHECK(count_of(text, "<Normal") == 1);
    const std::string empty = encoded({}, MeshFormat::x3d);
    CHECK(contains(empty, " <Scene>\n </Scene>\n</X3D>\n"));
}

TEST_CASE("VRML and X3D: a triangle that names a vertex twice is no face") {
    Scene scene;
    Mesh mesh = tetrahedron();
    mesh.triangles = {{0, 0, 1}, {0, 1, 2}};
    scene.objects.push_back({"flat", mesh, {}});
    for (const MeshFormat format : {MeshFormat::vrml, MeshFormat::x3d}) {
        const std::string text = encoded(scene, format);
        CHECK(contains(text, "\n0 1 2 -1\n"));
        CHECK(count_of(text, " -1\n") == 1);
    }
    scene.objects[0].mesh.triangles.pop_back();
    CHECK(encoded(scene, MeshFormat::vrml) == encoded({}, MeshFormat::vrml));
    CHECK(encoded(scene, MeshFormat::x3d) == encoded({}, MeshFormat::x3d));
}
