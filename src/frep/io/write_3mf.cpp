// 3MF (3MF Consortium, Core Specification 1.3; Materials and Properties Extension 1.2 for colors of
// vertices): one object and one build item a mesh. Vertices at equal positions are joined and triangles that
// collapse are dropped, as the format asks. An object whose edges do not each lie in two triangles, oriented
// alike, is of type "surface", since "model" promises a solid (Core 3.4). Read back by lib3mf in
// tests/validators.
#include <algorithm>
#include <array>
#include <numeric>

#include "frep/io/encode.h"
#include "frep/io/text.h"
#include "frep/io/writers.h"
#include "frep/io/zip.h"

namespace frep::encode {

namespace {

struct Unit {
    std::string_view name;
    double metres;
};
constexpr std::array units{Unit{"micron", 1e-6}, Unit{"millimeter", 1e-3}, Unit{"centimeter", 1e-2},
                           Unit{"inch", 0.0254}, Unit{"foot", 0.3048},     Unit{"meter", 1}};

/// The vertices that are written and the triangles on them; `corner` keeps the mesh's own numbers, for
/// colors.
struct Solid {
    std::vector<std::array<float, 3>> vertices;
    std::vector<Triangle> triangles, corners;
};

/// For each vertex the first vertex of equal position.
std::vector<std::uint32_t> first_at_position(const std::vector<std::array<float, 3>>& points) {
    std::vector<std::uint32_t> order(points.size()), first(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&points](std::uint32_t a, std::uint32_t b) {
        return points[a] != points[b] ? points[a] < points[b] : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool equal = i > 0 && points[order[i]] == points[order[i - 1]];
        first[order[i]] = equal ? first[order[i - 1]] : order[i];
    }
    return first;
}

Solid solid_of(const Mesh& mesh, double scale) {
    std::vector<std::array<float, 3>> points;
    points.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) {
        points.push_back({static_cast<float>(v.x * scale) + 0.0f, static_cast<float>(v.y * scale) + 0.0f,
                          static_cast<float>(v.z * scale) + 0.0f});
    }
    const std::vector<std::uint32_t> first = first_at_position(points);
    Solid solid;
    constexpr std::uint32_t none = 0xffffffffu;
    std::vector<std::uint32_t> place(points.size(), none);
    for (const Triangle& t : mesh.triangles) {
        Triangle moved{first[t[0]], first[t[1]], first[t[2]]};
        if (moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0]) continue;
        for (std::uint32_t& v : moved) {
            if (place[v] == none) {
                place[v] = static_cast<std::uint32_t>(solid.vertices.size());
                solid.vertices.push_back(points[v]);
            }
            v = place[v];
        }
        solid.triangles.push_back(moved);
        solid.corners.push_back(t);
    }
    return solid;
}

void append_attribute(std::string& out, std::string_view name, std::string_view text) {
    out.push_back(' ');
    out += name;
    out += "=\"";
    append_xml(out, text);
    out.push_back('"');
}

void append_attribute(std::string& out, std::string_view name, std::uint64_t number) {
    out.push_back(' ');
    out += name;
    out += "=\"";
    append_number(out, number);
    out.push_back('"');
}

void append_metadata(std::string& out, std::string_view name, std::string_view text) {
    if (text.empty()) return;
    out += " <metadata name=\"";
    out += name;
    out += "\">";
    append_xml(out, text);
    out += "</metadata>\n";
}

void append_base_material(std::string& out, std::uint64_t id, const ObjectView& object) {
    out += "  <basematerials";
    append_attribute(out, "id", id);
    out += "><base";
    append_attribute(out, "name", object.name.empty() ? "material" : object.name);
    out += " displaycolor=\"";
    append_hex_color(out, color_bits(object.material.base));
    out += "\"/></basematerials>\n";
}

void append_color_group(std::string& out, std::uint64_t id, const Palette& palette) {
    out += "  <m:colorgroup";
    append_attribute(out, "id", id);
    out += ">\n";
    for (const std::uint32_t color : palette.colors) {
        out += "   <m:color color=\"";
        append_hex_color(out, color);
        out += "\"/>\n";
    }
    out += "  </m:colorgroup>\n";
}

void append_vertices(std::string& out, const Solid& solid) {
    out += "    <vertices>\n";
    for (const auto& v : solid.vertices) {
        out += "     <vertex x=\"";
        append_number(out, v[0]);
        out += "\" y=\"";
        append_number(out, v[1]);
        out += "\" z=\"";
        append_number(out, v[2]);
        out += "\"/>\n";
    }
    out += "    </vertices>\n";
}

/// Triangles, with the colors of their corners where there is a color group.
void append_triangles(std::string& out, const Solid& solid, std::uint64_t group,
                      const std::vector<std::uint32_t>& color) {
    out += "    <triangles>\n";
    for (std::size_t i = 0; i < solid.triangles.size(); ++i) {
        out += "     <triangle";
        append_attribute(out, "v1", std::uint64_t{solid.triangles[i][0]});
        append_attribute(out, "v2", std::uint64_t{solid.triangles[i][1]});
        append_attribute(out, "v3", std::uint64_t{solid.triangles[i][2]});
        if (!color.empty()) {
            const Triangle& t = solid.corners[i];
            const std::uint64_t a = color[t[0]], b = color[t[1]], c = color[t[2]];
            append_attribute(out, "pid", group);
            append_attribute(out, "p1", a);
            if (a != b || b != c) {
                append_attribute(out, "p2", b);
                append_attribute(out, "p3", c);
            }
        }
        out += "/>\n";
    }
    out += "    </triangles>\n";
}

/// The resources of one object: its base material or color group `id`, and the object `id` + 1.
void append_object(std::string& out, std::uint64_t id, const ObjectView& object, const Solid& solid) {
    std::vector<std::uint32_t> color;
    if (object.mesh->colors.empty()) {
        append_base_material(out, id, object);
    } else {
        const Palette palette = palette_of(object);
        color.reserve(object.mesh->vertices.size());
        for (std::size_t i = 0; i < object.mesh->vertices.size(); ++i) {
            color.push_back(palette.index(color_bits(vertex_color(object, i))));
        }
        append_color_group(out, id, palette);
    }
    out += "  <object";
    append_attribute(out, "id", id + 1);
    if (!object.name.empty()) append_attribute(out, "name", object.name);
    append_attribute(out, "type", is_closed(solid.triangles) ? "model" : "surface");
    append_attribute(out, "pid", id);
    append_attribute(out, "pindex", std::uint64_t{0});
    out += ">\n   <mesh>\n";
    append_vertices(out, solid);
    append_triangles(out, solid, id, color);
    out += "   </mesh>\n  </object>\n";
}

std::string model_part(const SceneView& scene) {
    const Scale3mf scale = scale_3mf(scene.unit);
    std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model";
    append_attribute(out, "unit", scale.unit);
    out +=
        " xml:lang=\"en-US\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
        "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\">\n";
    append_metadata(out, "Title", scene.title);
    append_metadata(out, "Designer", scene.author);
    append_metadata(out, "LicenseTerms", scene.license);
    append_metadata(out, "Description", scene.source);
    append_metadata(out, "Application", "frep");
    std::string items;
    std::uint64_t id = 1;
    out += " <resources>\n";
    for (const ObjectView& object : scene.objects) {
        const Solid solid = solid_of(*object.mesh, scale.factor);
        if (solid.triangles.empty()) continue;
        append_object(out, id, object, solid);
        items += "  <item";
        append_attribute(items, "objectid", id + 1);
        items += "/>\n";
        id += 2;
    }
    out += " </resources>\n <build>\n" + items + " </build>\n</model>\n";
    return out;
}

constexpr std::string_view content_types =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    " <Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    " <Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
    "</Types>\n";

constexpr std::string_view relationships =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
    " <Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n"
    "</Relationships>\n";

}  // namespace

Scale3mf scale_3mf(const LengthUnit& unit) {
    for (const Unit& known : units) {
        if (known.metres == unit.metres) return {known.name, 1};
    }
    return {"millimeter", unit.metres * 1000};
}

Result<std::string> write_3mf(const SceneView& scene) {
    return zip({{"[Content_Types].xml", std::string(content_types)},
                {"_rels/.rels", std::string(relationships)},
                {"3D/3dmodel.model", model_part(scene)}});
}

}  // namespace frep::encode
