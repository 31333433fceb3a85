// OBJ (Wavefront, Object Files, appendix B1 of the Advanced Visualizer manual): vertices with colors as most
// programs add them (v x y z r g b), normals, faces with polygons and negative indices, objects and groups,
// materials. A mesh has one normal a vertex here; where faces give a vertex several, the object's normals are
// dropped. Vertices that no face of an object names are left out; a file without faces gives its points.
// Tested by tests/unit/io/read_obj_test.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "frep/io/read_formats.h"
#include "frep/io/read_polygon.h"

namespace frep::reading {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

struct Part {
    std::string name;
    std::optional<Material> material;  ///< one that the libraries know
    std::vector<Triangle> triangles;   ///< of the file's vertices
    bool has_normals = true;           ///< every corner named one, and every vertex one only
    std::vector<std::pair<std::uint32_t, std::uint32_t>> normals;  ///< vertex, normal of its first corner
};

class ObjReader {
  public:
    ObjReader(std::string_view bytes, Context& context) : words_(bytes, true, true), context_(context) {}

    Result<Scene> read() {
        do {
            std::string_view keyword;
            if (!words_.next_in_line(keyword)) continue;
            if (const Status status = read_line(keyword); !status) return status.error();
        } while (words_.next_line());
        finish_part();
        return finish();
    }

  private:
    Error error(std::string_view message) const { return malformed_line(words_.line(), message); }

    Status read_line(std::string_view keyword) {
        if (keyword == "v") return read_vertex();
        if (keyword == "vn") return read_normal();
        if (keyword == "f" || keyword == "fo") return read_face();
        if (keyword == "vt") {
            ++textures_;
        } else if (keyword == "o" || keyword == "g") {
            begin_part();
            part_.name = object_name(words_.rest_of_line());
        } else if (keyword == "usemtl") {
            use_material(object_name(words_.rest_of_line()));
        } else if (keyword == "mtllib") {
            return read_library();
        } else if (keyword == "l" || keyword == "p") {
            ++lines_;
        } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
            ++curves_;
        }
        return {};
    }

    Status read_numbers(std::string_view what, std::vector<double>& out) {
        out.clear();
        std::string_view word;
        while (out.size() < 8 && words_.next_in_line(word)) {
            const auto value = parse_number<double>(word);
            if (!value) return error(fmt::format("expected a number in a {}, found {}", what, quoted(word)));
            out.push_back(*value);
        }
        if (out.size() < 3) return error(fmt::format("a {} needs 3 numbers", what));
        return {};
    }

    Status read_vertex() {
        if (const Status status = read_numbers("vertex", numbers_); !status) return status;
        const Vec3 p{numbers_[0], numbers_[1], numbers_[2]};
        if (!is_finite(p)) return error("the coordinate is not finite");
        positions_.push_back(p);
        const std::size_t n = numbers_.size();
        if (n >= 6) {
            colors_.push_back({numbers_[3], numbers_[4], numbers_[5]});
        } else {
            all_colored_ = false;
        }
        return {};
    }

    Status read_normal() {
        if (const Status status = read_numbers("normal", numbers_); !status) return status;
        normals_.push_back({numbers_[0], numbers_[1], numbers_[2]});
        return {};
    }

    /// The index that `text` means in a list of `count`: from 1, or backwards from -1.
    static std::uint32_t resolved(std::string_view text, std::size_t count) {
        const auto value = parse_integer(text);
        const auto size = static_cast<std::int64_t>(count);
        if (!value || *value == 0 || *value > size || *value < -size) return none;
        return static_cast<std::uint32_t>(*value > 0 ? *value - 1 : size + *value);
    }

    Status read_face() {
        corners_.clear();
        std::string_view word;
        while (words_.next_in_line(word)) {
            const std::size_t slash = word.find('/');
            const std::uint32_t corner = resolved(word.substr(0, slash), positions_.size());
            if (corner == none)
                return error(fmt::format("a face names vertex {}; {} stand before it", quoted(word),
                                         positions_.size()));
            corners_.push_back(corner);
            const std::size_t second = slash == std::string_view::npos ? slash : word.find('/', slash + 1);
            if (second == std::string_view::npos) {
                part_.has_normals = false;
                continue;
            }
            const std::uint32_t normal = resolved(word.substr(second + 1), normals_.size());
            if (normal == none)
                return error(
                    fmt::format("a face names normal {}; {} stand before it", quoted(word), normals_.size()));
            if (part_.has_normals) part_.normals.push_back({corner, normal});
        }
        triangulator_.add(positions_, corners_, part_.triangles);
        return {};
    }

    void begin_part() {
        finish_part();
        part_.triangles.clear();
        part_.normals.clear();
        part_.has_normals = true;
    }

    void use_material(const std::string& name) {
        begin_part();
        part_.material.reset();
        const auto known = materials_.find(name);
        if (known != materials_.end()) part_.material = known->second;
    }

    Status read_library() {
        const std::string_view name = words_.rest_of_line();
        if (!context_.options.read_companion) {
            note_dropped(context_.report, 1, "material library");
            return {};
        }
        if (libraries_ == 16) return error("the file names more than 16 material libraries");
        ++libraries_;
        const auto bytes = context_.options.read_companion(name);
        if (!bytes) {
            note_dropped(context_.report, 1,
                         fmt::format("material library that cannot be read ({})", quoted(name)));
            return {};
        }
        for (const NamedMaterial& named : read_mtl(*bytes)) materials_.emplace(named.name, named.material);
        return {};
    }

    void finish_part() {
        if (part_.triangles.empty()) return;
        SceneObject object;
        object.name = part_.name;
        if (part_.material) object.material = *part_.material;
        plain_.push_back(!part_.material);
        std::vector<std::uint32_t> used;
        for (const Triangle& t : part_.triangles) used.insert(used.end(), t.begin(), t.end());
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        place_.resize(positions_.size());
        for (std::size_t i = 0; i < used.size(); ++i) {
            place_[used[i]] = static_cast<std::uint32_t>(i);
            object.mesh.vertices.push_back(positions_[used[i]]);
        }
        for (const Triangle& t : part_.triangles)
            object.mesh.triangles.push_back({place_[t[0]], place_[t[1]], place_[t[2]]});
        add_normals(used, object.mesh);
        objects_.push_back(std::move(object));
        used_.push_back(std::move(used));
        part_.triangles.clear();
    }

    void add_normals(const std::vector<std::uint32_t>& used, Mesh& mesh) {
        if (!part_.has_normals) return;
        std::vector<std::uint32_t> of_vertex(used.size(), none);
        for (const auto& [vertex, normal] : part_.normals) {
            if (!std::binary_search(used.begin(), used.end(), vertex)) continue;
            std::uint32_t& known = of_vertex[place_[vertex]];
            if (known == none) known = normal;
            const Vec3 a = normals_[known], b = normals_[normal];
            if (a.x == b.x && a.y == b.y && a.z == b.z) continue;
            ++sharp_objects_;
            return;
        }
        for (const std::uint32_t normal : of_vertex) mesh.normals.push_back(normals_[normal]);
    }

    Scene finish() {
        note_dropped(context_.report, textures_, "texture coordinate");
        note_dropped(context_.report, lines_, "line or point element");
        note_dropped(context_.report, curves_, "curve or free-form surface");
        note_dropped(context_.report, sharp_objects_, "object's normals, which differ at one vertex");
        note_dropped(context_.report, triangulator_.dropped_faces(), "face with fewer than 3 corners");
        note_dropped(context_.report, triangulator_.dropped_triangles(),
                     "triangle that names a vertex twice");
        Scene scene;
        if (objects_.empty() && !positions_.empty()) {
            objects_.emplace_back();
            objects_[0].mesh.vertices = std::move(positions_);
            scale_colors(colors_);
            if (all_colored_) objects_[0].material.base = {1, 1, 1};
            if (all_colored_) objects_[0].mesh.colors = std::move(colors_);
        } else if (all_colored_) {
            scale_colors(colors_);
            for (std::size_t i = 0; i < objects_.size(); ++i) {
                if (plain_[i]) objects_[i].material.base = {1, 1, 1};
                for (const std::uint32_t vertex : used_[i])
                    objects_[i].mesh.colors.push_back(colors_[vertex]);
            }
        } else {
            note_dropped(context_.report, colors_.size(), "color, since other vertices have none");
        }
        scene.objects = std::move(objects_);
        return scene;
    }

    Words words_;
    Context& context_;
    std::vector<Vec3> positions_, normals_;
    std::vector<Color> colors_;
    bool all_colored_ = true;
    std::map<std::string, Material> materials_;
    Part part_;
    std::vector<SceneObject> objects_;
    std::vector<std::vector<std::uint32_t>> used_;  ///< of each object: the file's vertices, in order
    std::vector<bool> plain_;                       ///< of each object: without a material
    std::vector<std::uint32_t> place_, corners_;
    std::vector<double> numbers_;
    Triangulator triangulator_;
    std::size_t textures_ = 0, lines_ = 0, curves_ = 0, libraries_ = 0, sharp_objects_ = 0;
};

}  // namespace

Result<Scene> read_obj(std::string_view bytes, Context& context) { return ObjReader(bytes, context).read(); }

}  // namespace frep::reading
