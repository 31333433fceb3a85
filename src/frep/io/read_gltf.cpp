// glTF 2.0 (Khronos, ISO/IEC 12113:2022), .glb and .gltf: the nodes of the scene, each primitive of a mesh an
// object with its transform applied. Metres and Y up become the wanted unit and Z up: (x, y, z) is (x, -z, y)
// here. COLOR_0 is linear light and becomes sRGB. Skins, morph targets, animations, textures and cameras are
// dropped. Tested by tests/unit/io/read_gltf_test.cpp.
#include <fmt/format.h>

#include <array>

#include "frep/io/read_gltf_data.h"

namespace frep::reading {

namespace {

/// An affine map: the columns of its matrix, and where it takes the origin.
struct Affine {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};

    Vec3 direction(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
    Vec3 point(const Vec3& v) const { return direction(v) + origin; }
    Affine after(const Affine& inner) const {
        return {direction(inner.x), direction(inner.y), direction(inner.z), point(inner.origin)};
    }
    double determinant() const { return dot(cross(x, y), z); }
    /// Normals go with the cofactors of the matrix; the sign keeps them outward under a reflection.
    Vec3 normal(const Vec3& n) const {
        const Vec3 moved = n.x * cross(y, z) + n.y * cross(z, x) + n.z * cross(x, y);
        return determinant() < 0 ? -1.0 * moved : moved;
    }
};

/// A node's own transform (3.5.3). Errors: io.
Result<Affine> node_transform(const Json& node, std::size_t index) {
    const auto bad = [index](std::string_view key, std::string_view wanted) {
        return Error{ErrorKind::io, fmt::format("nodes[{}].{} is not {} numbers", index, key, wanted)};
    };
    Affine out;
    if (member(node, "matrix")) {
        std::array<double, 16> m{};
        if (!numbers_member(node, "matrix", m.data(), 16)) return bad("matrix", "16");
        return Affine{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    std::array<double, 3> t{0, 0, 0}, s{1, 1, 1};
    std::array<double, 4> q{0, 0, 0, 1};
    if (member(node, "translation") && !numbers_member(node, "translation", t.data(), 3))
        return bad("translation", "3");
    if (member(node, "scale") && !numbers_member(node, "scale", s.data(), 3)) return bad("scale", "3");
    if (member(node, "rotation") && !numbers_member(node, "rotation", q.data(), 4))
        return bad("rotation", "4");
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    out.x = s[0] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
    out.y = s[1] * Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
    out.z = s[2] * Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
    out.origin = {t[0], t[1], t[2]};
    return out;
}

double unit_range(double value) { return value > 0 ? (value < 1 ? value : 1) : 0; }

class GltfReader {
  public:
    GltfReader(const GltfData& data, Context& context) : data_(data), root_(data.root()), context_(context) {
        budget_ = data.byte_count() + context.options.instance_limit;
    }

    Result<Scene> read() {
        if (const Status status = find_roots(); !status) return status.error();
        while (!stack_.empty()) {
            const auto [node, transform] = stack_.back();
            stack_.pop_back();
            if (const Status status = visit(node, transform); !status) return status.error();
        }
        report();
        return std::move(scene_);
    }

  private:
    struct Pending {
        std::size_t node;
        Affine transform;
    };

    static Error bad(std::string message) { return {ErrorKind::io, std::move(message)}; }
    std::size_t size_of(const char* key) const {
        const Json* list = array_member(root_, key);
        return list ? list->size() : 0;
    }

    /// The nodes of the default scene; without scenes, those that are no children.
    Status find_roots() {
        visited_.assign(size_of("nodes"), false);
        // Z up in the wanted unit: the map that every node's transform is followed by.
        const double scale = 1 / context_.options.unit.metres;
        const Affine base{{scale, 0, 0}, {0, 0, scale}, {0, -scale, 0}, {0, 0, 0}};
        const Json* chosen = member(root_, "scene");
        const auto number = chosen ? as_index(chosen) : std::optional<std::size_t>(0);
        if (const Json* scene = number ? item(root_, "scenes", *number) : nullptr) {
            if (size_of("scenes") > 1) note_dropped(context_.report, size_of("scenes") - 1, "further scene");
            return push_nodes(*scene, "nodes", base, fmt::format("scenes[{}]", *number));
        }
        if (chosen) return bad("`scene` names none of the scenes");
        std::vector<bool> is_child(visited_.size(), false);
        for (std::size_t i = 0; i < visited_.size(); ++i)
            if (const Json* children = array_member(*item(root_, "nodes", i), "children"))
                for (const Json& child : *children)
                    if (const auto k = as_index(&child); k && *k < is_child.size()) is_child[*k] = true;
        for (std::size_t i = visited_.size(); i-- > 0;)
            if (!is_child[i]) stack_.push_back({i, base});
        return {};
    }

    Status push_nodes(const Json& owner, const char* key, const Affine& transform, const std::string& name) {
        const Json* list = array_member(owner, key);
        if (!list) return {};
        for (std::size_t i = list->size(); i-- > 0;) {
            const auto node = as_index(&(*list)[i]);
            if (!node || *node >= visited_.size())
                return bad(fmt::format("{}.{}[{}] names none of the nodes", name, key, i));
            stack_.push_back({*node, transform});
        }
        return {};
    }

    Status visit(std::size_t index, const Affine& outer) {
        if (visited_[index]) return bad(fmt::format("nodes[{}] stands in the tree of nodes twice", index));
        visited_[index] = true;
        const Json& node = *item(root_, "nodes", index);
        const auto own = node_transform(node, index);
        if (!own) return own.error();
        const Affine transform = outer.after(*own);
        if (const Json* mesh_number = member(node, "mesh")) {
            const auto number = as_index(mesh_number);
            const Json* mesh = number ? item(root_, "meshes", *number) : nullptr;
            if (!mesh) return bad(fmt::format("nodes[{}].mesh names none of the meshes", index));
            const std::string_view name = text_member(node, "name");
            if (const Status status = add_mesh(*mesh, *number, name, transform); !status) return status;
        }
        return push_nodes(node, "children", transform, fmt::format("nodes[{}]", index));
    }

    Status add_mesh(const Json& mesh, std::size_t index, std::string_view node_name,
                    const Affine& transform) {
        const Json* primitives = array_member(mesh, "primitives");
        if (!primitives) return bad(fmt::format("meshes[{}] has no primitives", index));
        const std::string name = object_name(node_name.empty() ? text_member(mesh, "name") : node_name);
        for (std::size_t i = 0; i < primitives->size(); ++i) {
            const std::string place = fmt::format("meshes[{}].primitives[{}]", index, i);
            if (const Status status = add_primitive((*primitives)[i], place, name, transform); !status)
                return status;
        }
        return {};
    }

    Status spend(std::size_t count) {
        if (count > budget_)
            return Error{ErrorKind::over_limit,
                         "the file shows its meshes so often that the scene would be too large"};
        budget_ -= count;
        return {};
    }

    Status add_primitive(const Json& primitive, const std::string& place, const std::string& name,
                         const Affine& transform) {
        const Json* mode_entry = member(primitive, "mode");
        const auto mode = mode_entry ? as_index(mode_entry) : std::optional<std::size_t>(4);
        if (!mode || *mode > 6) return bad(fmt::format("{}.mode is not in 0..6", place));
        if (*mode < 4) return ++lines_, Status{};
        const Json* attributes = member(primitive, "attributes");
        const Json* position = attributes ? member(*attributes, "POSITION") : nullptr;
        if (!position) return ++invisible_, Status{};
        if (member(primitive, "targets")) ++morphs_;
        // An object takes a few hundred bytes, however empty it is.
        if (const Status status = spend(16); !status) return status;
        SceneObject object;
        object.name = name;
        if (const Status status = read_vertices(*attributes, place, transform, object.mesh); !status)
            return status;
        if (const Status status = read_material(primitive, place, object); !status) return status;
        std::vector<std::uint32_t> corners;
        if (const Status status = read_corners(primitive, place, object.mesh, corners); !status)
            return status;
        make_triangles(*mode, transform.determinant() < 0, corners, object.mesh);
        scene_.objects.push_back(std::move(object));
        return {};
    }

    /// The accessor of an attribute with that many vertices and 3 (or up to `most`) components.
    Result<Accessor> attribute(const Json* entry, const std::string& place, std::string_view name,
                               std::size_t most) const {
        const auto index = as_index(entry);
        if (!index) return bad(fmt::format("{}.attributes.{} is no whole number", place, name));
        auto accessor = data_.accessor(*index);
        if (!accessor) return accessor;
        if (accessor->components < 3 || accessor->components > most)
            return bad(fmt::format("accessors[{}], which {} uses as {}, has {} components", *index, place,
                                   name, accessor->components));
        return accessor;
    }

    Status read_vertices(const Json& attributes, const std::string& place, const Affine& transform,
                         Mesh& mesh) {
        const auto positions = attribute(member(attributes, "POSITION"), place, "POSITION", 3);
        if (!positions) return positions.error();
        const std::size_t count = positions->count;
        if (const Status status = spend(count); !status) return status;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 p =
                transform.point({positions->number(i, 0), positions->number(i, 1), positions->number(i, 2)});
            if (!is_finite(p))
                return bad(fmt::format("{}: vertex {} has a coordinate that is not finite", place, i));
            mesh.vertices.push_back(p);
        }
        if (const Json* entry = member(attributes, "NORMAL")) {
            const auto normals = attribute(entry, place, "NORMAL", 3);
            if (!normals) return normals.error();
            if (normals->count != count)
                return bad(fmt::format("{} has {} normals for {} vertices", place, normals->count, count));
            for (std::size_t i = 0; i < count; ++i) {
                const Vec3 n =
                    transform.normal({normals->number(i, 0), normals->number(i, 1), normals->number(i, 2)});
                const double size = length(n);
                mesh.normals.push_back(size > 0 && is_finite(size) ? n / size : Vec3{0, 0, 0});
            }
        }
        if (const Json* entry = member(attributes, "COLOR_0")) {
            const auto colors = attribute(entry, place, "COLOR_0", 4);
            if (!colors) return colors.error();
            if (colors->count != count)
                return bad(fmt::format("{} has {} colors for {} vertices", place, colors->count, count));
            for (std::size_t i = 0; i < count; ++i)
                mesh.colors.push_back(
                    srgb_from_linear({colors->number(i, 0), colors->number(i, 1), colors->number(i, 2)}));
        }
        for (const auto& [key, value] : attributes.items())
            textures_ += key.starts_with("TEXCOORD_") && value.is_number();
        return {};
    }

    Status read_material(const Json& primitive, const std::string& place, SceneObject& object) {
        const Json* entry = member(primitive, "material");
        if (!entry) {
            if (!object.mesh.colors.empty()) object.material.base = {1, 1, 1};
            return {};
        }
        const auto index = as_index(entry);
        const Json* material = index ? item(root_, "materials", *index) : nullptr;
        if (!material) return bad(fmt::format("{}.material names none of the materials", place));
        std::array<double, 4> base{1, 1, 1, 1};
        object.material.metallic = object.material.roughness = 1;
        if (const Json* look = member(*material, "pbrMetallicRoughness")) {
            numbers_member(*look, "baseColorFactor", base.data(), 4);
            object.material.metallic = unit_range(number_member(*look, "metallicFactor", 1));
            object.material.roughness = unit_range(number_member(*look, "roughnessFactor", 1));
        }
        object.material.base = srgb_from_linear({base[0], base[1], base[2]});
        if (const Json* extensions = member(*material, "extensions"))
            if (const Json* coat = member(*extensions, "KHR_materials_clearcoat"))
                object.material.clearcoat = unit_range(number_member(*coat, "clearcoatFactor", 0));
        return {};
    }

    Status read_corners(const Json& primitive, const std::string& place, const Mesh& mesh,
                        std::vector<std::uint32_t>& corners) {
        const Json* entry = member(primitive, "indices");
        if (!entry) {
            if (const Status status = spend(mesh.vertices.size()); !status) return status;
            for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
                corners.push_back(static_cast<std::uint32_t>(i));
            return {};
        }
        const auto index = as_index(entry);
        if (!index) return bad(fmt::format("{}.indices is no whole number", place));
        const auto indices = data_.accessor(*index);
        if (!indices) return indices.error();
        const bool unsigned_type = indices->component_type == 5121 || indices->component_type == 5123 ||
                                   indices->component_type == 5125;
        if (indices->components != 1 || !unsigned_type)
            return bad(fmt::format("accessors[{}] has no type of indices", *index));
        if (const Status status = spend(indices->count); !status) return status;
        for (std::size_t i = 0; i < indices->count; ++i) {
            const std::uint32_t corner = indices->integer(i);
            if (corner >= mesh.vertices.size())
                return bad(fmt::format("{}: index {} names vertex {}; there are {}", place, i, corner,
                                       mesh.vertices.size()));
            corners.push_back(corner);
        }
        return {};
    }

    /// Triangles (mode 4), strips (5) or fans (6); turned round where the transform is a reflection.
    void make_triangles(std::size_t mode, bool reflected, const std::vector<std::uint32_t>& corners,
                        Mesh& mesh) {
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            if (a == b || b == c || c == a) {
                ++collapsed_;
            } else {
                mesh.triangles.push_back(reflected ? Triangle{a, c, b} : Triangle{a, b, c});
            }
        };
        const std::size_t n = corners.size();
        if (mode == 4)
            for (std::size_t i = 0; i + 2 < n; i += 3) add(corners[i], corners[i + 1], corners[i + 2]);
        if (mode == 5)
            for (std::size_t i = 0; i + 2 < n; ++i)
                add(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
        if (mode == 6)
            for (std::size_t i = 1; i + 1 < n; ++i) add(corners[i], corners[i + 1], corners[0]);
    }

    void report() {
        context_.report.unit_stated = true;
        note_dropped(context_.report, lines_, "primitive of lines or points");
        note_dropped(context_.report, invisible_, "primitive without POSITION");
        note_dropped(context_.report, morphs_, "primitive's morph targets");
        note_dropped(context_.report, textures_, "set of texture coordinates");
        note_dropped(context_.report, size_of("textures"), "texture");
        note_dropped(context_.report, size_of("skins"), "skin");
        note_dropped(context_.report, size_of("animations"), "animation");
        note_dropped(context_.report, size_of("cameras"), "camera");
        note_dropped(context_.report, collapsed_, "triangle that names a vertex twice");
    }

    const GltfData& data_;
    const Json& root_;
    Context& context_;
    std::size_t budget_ = 0;  ///< vertices and corners that the scene may still get
    std::vector<Pending> stack_;
    std::vector<bool> visited_;
    Scene scene_;
    std::size_t lines_ = 0, invisible_ = 0, morphs_ = 0, textures_ = 0, collapsed_ = 0;
};

}  // namespace

Result<Scene> read_gltf(std::string_view bytes, Context& context) {
    const auto data = GltfData::open(bytes, context.options);
    if (!data) return data.error();
    return GltfReader(*data, context).read();
}

}  // namespace frep::reading
