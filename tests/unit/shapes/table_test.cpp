// The library table as a whole: every row is documented, cites known sources, and fits its builder; names are
// found in any case; nothing warns about good calls, and wrong array sizes give the error value.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using shapes::ArgumentKind;

TEST_CASE("every row is documented") {
    const std::string sources = content_of(FREP_SOURCE_DIR "/docs/bibliography.md");
    REQUIRE(sources.size() > 1000);
    for (const auto& row : shapes::library()) {
        CAPTURE(row.name);
        CHECK(row.name.starts_with("hf"));
        CHECK(row.doc.size() >= 5);
        CHECK(row.doc.ends_with('.'));
        CHECK(row.formula.size() > 3);
        CHECK(!row.group.empty());
        CHECK((row.invoke != nullptr));
        CHECK(!row.arguments.empty());
        std::set<std::string_view> names;
        for (const auto& argument : row.arguments) {
            CHECK(!argument.name.empty());
            CHECK(argument.name.find_first_of(" ,") == std::string_view::npos);
            names.insert(argument.name);
        }
        CHECK(names.size() == row.arguments.size());
        if (!row.citation.empty())
            CHECK(sources.find("\n| " + std::string(row.citation) + " |") != std::string::npos);
        if (!row.note.empty()) CHECK(row.note.ends_with('.'));
    }
}

TEST_CASE("names are found in any case, and rows of one name stand together") {
    for (const auto& row : shapes::library()) {
        std::string upper(row.name);
        for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        const auto rows = shapes::find_functions(upper);
        REQUIRE(!rows.empty());
        CHECK(std::any_of(rows.begin(), rows.end(), [&](const auto& r) { return r.invoke == row.invoke; }));
        std::set<std::size_t> arities;
        for (const auto& r : rows) {
            CHECK(r.name == rows.front().name);
            arities.insert(r.arguments.size());
        }
        CHECK(arities.size() == rows.size());
    }
    CHECK(shapes::find_functions("hfNothing").empty());
    CHECK(shapes::find_functions("").empty());
    CHECK(shapes::find_functions("hfA_SmoothStep").size() == 2);
    CHECK(shapes::find_functions("hfVoxel").size() == 2);
}

TEST_CASE("the old library is complete and reserved") {
    const char* const old_names[] = {"hfSphere",
                                     "hfEllipsoid",
                                     "hfCylinderX",
                                     "hfCylinderY",
                                     "hfCylinderZ",
                                     "hfEllCylX",
                                     "hfEllCylY",
                                     "hfEllCylZ",
                                     "hfTorusX",
                                     "hfTorusY",
                                     "hfTorusZ",
                                     "hfBlock",
                                     "hfSuperell",
                                     "hfConeX",
                                     "hfConeY",
                                     "hfConeZ",
                                     "hfEllConeX",
                                     "hfEllConeY",
                                     "hfEllConeZ",
                                     "hfNoiseG",
                                     "hfBlobby",
                                     "hfMetaball",
                                     "hfSoft",
                                     "hfFMapBlob",
                                     "hfConvPoint",
                                     "hfConvLine",
                                     "hfConvCurve",
                                     "hfConvTriangle",
                                     "hfConvMesh",
                                     "hfConvArc",
                                     "hfConvLineR",
                                     "hfBezierVolume",
                                     "hfCubicBSpline",
                                     "hfVoxel",
                                     "hfScale3D",
                                     "hfShift3D",
                                     "hfRotate3DX",
                                     "hfRotate3DY",
                                     "hfRotate3DZ",
                                     "hfTwistX",
                                     "hfTwistY",
                                     "hfTwistZ",
                                     "hfTaperX",
                                     "hfTaperY",
                                     "hfTaperZ",
                                     "hfStretch3D",
                                     "hfSpaceMapCubic",
                                     "hfSpaceMapExp",
                                     "hfBlendUni",
                                     "hfBlendInt",
                                     "hfDConeX",
                                     "hfDConeY",
                                     "hfDConeZ",
                                     "hfDCylinder",
                                     "hfDTorusX",
                                     "hfDTorusY",
                                     "hfDTorusZ",
                                     "hfDEllipsoid",
                                     "hfDBlock",
                                     "hfDUni",
                                     "hfDInt",
                                     "hfDSub",
                                     "hfDBlendUni",
                                     "hfDBlendInt",
                                     "hfSawtooth",
                                     "hfA_Wave",
                                     "hfA_NoiseG",
                                     "hfA_NoiseP",
                                     "hfA_Turbulence",
                                     "hfA_CheckerBoard",
                                     "hfA_Union",
                                     "hfA_SetColor",
                                     "hfA_SetAttributes",
                                     "hfA_Lerp",
                                     "hfA_Cerp",
                                     "hfA_Clamp",
                                     "hfA_Step",
                                     "hfA_Pulse",
                                     "hfA_SmoothStep",
                                     "hfA_Modulo",
                                     "hfA_Floor",
                                     "hfA_LookUpTable",
                                     "hfA_SmoothLookUpTable",
                                     "hfA_Circles",
                                     "hfA_Crackles",
                                     "hfA_Spline",
                                     "hfA_RGBToHSV",
                                     "hfA_HSVToRGB"};
    std::set<std::string_view> reserved;
    for (const char* name : old_names) {
        CAPTURE(name);
        const auto rows = shapes::find_functions(name);
        REQUIRE(!rows.empty());
        CHECK(rows.front().name == name);
        CHECK(rows.front().reserved);
        reserved.insert(rows.front().name);
    }
    for (const auto& row : shapes::library()) CHECK(row.reserved == (reserved.count(row.name) > 0));
}

TEST_CASE("wrong array sizes give the error value and a warning") {
    for (const auto& row : shapes::library()) {
        const bool has_array = std::any_of(row.arguments.begin(), row.arguments.end(), [](const auto& a) {
            return a.kind == ArgumentKind::array || a.kind == ArgumentKind::array_in_out;
        });
        static const std::set<std::string_view> any_size = {
            "hfA_SetAttributes", "hfA_Union",        "hfA_Lerp",       "hfA_Cerp",       "hfA_CubicMix",
            "hfUnionOf",         "hfIntersectionOf", "hfSymmetricUni", "hfSymmetricInt", "hfNormalOffset",
            "hfNormalShell",     "hfPolarArrayX",    "hfPolarArrayY",  "hfPolarArrayZ"};
        if (!has_array || any_size.contains(row.name)) continue;
        CAPTURE(row.name);
        Sketch s;
        std::vector<shapes::ArgumentValue> values(row.arguments.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i].number = s.number(2);
            values[i].items = Items(i + 7, s.number(1));  // 7, 8, 9, ...: never what a function wants
        }
        const Expression result = row.invoke(s.build, values);
        CHECK(at(result, 0, 0, 0) == shapes::error_value);
        CHECK(s.warnings.size() == 1);
    }
}
