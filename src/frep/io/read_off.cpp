// OFF (Geomview, Object File Format), text: [ST][C][N]OFF, the counts, vertices, faces. The keyword may be
// missing. Components of colors are 0..1, or 0..255 if one is above 1. Colors of faces are dropped.
// Tested by tests/unit/io/read_off_test.cpp.
#include <fmt/format.h>

#include "frep/base/source.h"
#include "frep/io/read_formats.h"
#include "frep/io/read_polygon.h"

namespace frep::reading {

namespace {

class OffReader {
  public:
    OffReader(std::string_view bytes, Context& context) : words_(bytes, true), context_(context) {}

    Result<Scene> read() {
        if (const Status status = read_header(); !status) return status.error();
        for (std::size_t i = 0; i < vertex_count_; ++i)
            if (const Status status = read_vertex(i); !status) return status.error();
        for (std::size_t i = 0; i < face_count_; ++i)
            if (const Status status = read_face(i); !status) return status.error();
        std::string_view word;
        if (words_.next(word))
            return malformed_line(words_.line(), fmt::format("{} stands after the last face", quoted(word)));
        return finish();
    }

  private:
    Result<std::size_t> count(std::string_view word, std::string_view what, std::size_t least_bytes) {
        const auto value = parse_integer(word);
        if (!value || *value < 0)
            return malformed_line(words_.line(),
                                  fmt::format("expected the number of {}, found {}", what, quoted(word)));
        const auto count = static_cast<std::uint64_t>(*value);
        if (count > words_.remaining() / least_bytes + 1)
            return malformed_line(words_.line(), fmt::format("the file is too short for {} {}", count, what));
        return static_cast<std::size_t>(count);
    }

    Status read_header() {
        std::string_view word;
        if (!words_.next(word)) return malformed_line(words_.line(), "the file is empty");
        if (!parse_integer(word)) {
            std::string_view keyword = word;
            const auto take = [&keyword](std::string_view prefix) {
                const bool found = keyword.starts_with(prefix);
                if (found) keyword.remove_prefix(prefix.size());
                return found;
            };
            has_texture_ = take("ST");
            has_colors_ = take("C");
            has_normals_ = take("N");
            if (keyword != "OFF")
                return malformed_line(
                    words_.line(), fmt::format("expected OFF, COFF, NOFF or CNOFF, found {}", quoted(word)));
            if (!words_.next(word))
                return malformed_line(words_.line(), "the numbers of vertices and faces are missing");
            if (lower_case(word) == "binary") return malformed_line(words_.line(), "binary OFF is not read");
        }
        const auto vertices = count(word, "vertices", 6);
        if (!vertices) return vertices.error();
        if (!words_.next(word)) return malformed_line(words_.line(), "the number of faces is missing");
        const auto faces = count(word, "faces", 2);
        if (!faces) return faces.error();
        while (words_.next_in_line(word)) {
        }
        vertex_count_ = *vertices;
        face_count_ = *faces;
        return {};
    }

    /// The number of this or a later line that stands next.
    Result<double> number(std::string_view what, std::size_t index) {
        std::string_view word;
        if (!words_.next(word))
            return malformed_line(words_.line(), fmt::format("the file ends in {} {}", what, index));
        const auto value = parse_number<double>(word);
        if (!value || !is_finite(*value))
            return malformed_line(words_.line(), fmt::format("expected a finite number in {} {}, found {}",
                                                             what, index, quoted(word)));
        return *value;
    }

    Result<Vec3> vector(std::size_t index) {
        Vec3 p;
        for (double* value : {&p.x, &p.y, &p.z}) {
            const auto read = number("vertex", index);
            if (!read) return read.error();
            *value = *read;
        }
        return p;
    }

    Status read_vertex(std::size_t index) {
        const auto position = vector(index);
        if (!position) return position.error();
        mesh_.vertices.push_back(*position);
        if (has_normals_) {
            const auto normal = vector(index);
            if (!normal) return normal.error();
            mesh_.normals.push_back(*normal);
        }
        if (!has_colors_ && !has_texture_) return {};
        std::vector<double> rest;
        std::string_view word;
        while (rest.size() < 7 && words_.next_in_line(word)) {
            const auto value = parse_number<double>(word);
            if (!value)
                return malformed_line(words_.line(), fmt::format("expected a number in vertex {}, found {}",
                                                                 index, quoted(word)));
            rest.push_back(*value);
        }
        const std::size_t texture = has_texture_ ? 2 : 0, colors = has_colors_ ? 3 : 0;
        if (rest.size() < texture + colors || rest.size() > texture + colors + (has_colors_ ? 1 : 0))
            return malformed_line(words_.line(),
                                  fmt::format("vertex {} has {} numbers after its position{}", index,
                                              rest.size(), has_normals_ ? " and normal" : ""));
        if (has_colors_) mesh_.colors.push_back({rest[0], rest[1], rest[2]});
        if (rest.size() == texture + 4) ++opacities_;
        return {};
    }

    Status read_face(std::size_t index) {
        std::string_view word;
        if (!words_.next(word))
            return malformed_line(words_.line(),
                                  fmt::format("the file ends before face {} of {}", index, face_count_));
        const auto size = count(word, "corners", 2);
        if (!size) return size.error();
        corners_.clear();
        for (std::size_t i = 0; i < *size; ++i) {
            if (!words_.next(word))
                return malformed_line(words_.line(), fmt::format("the file ends in face {}", index));
            const auto corner = parse_integer(word);
            if (!corner || *corner < 0 || static_cast<std::uint64_t>(*corner) >= mesh_.vertices.size())
                return malformed_line(words_.line(), fmt::format("face {} names vertex {}; there are {}",
                                                                 index, quoted(word), mesh_.vertices.size()));
            corners_.push_back(static_cast<std::uint32_t>(*corner));
        }
        if (words_.next_in_line(word)) ++face_colors_;
        while (words_.next_in_line(word)) {
        }
        triangulator_.add(mesh_.vertices, corners_, mesh_.triangles);
        return {};
    }

    Scene finish() {
        scale_colors(mesh_.colors);
        note_dropped(context_.report, face_colors_, "face color");
        note_dropped(context_.report, has_texture_ ? mesh_.vertices.size() : 0, "texture coordinate");
        note_dropped(context_.report, opacities_, "opacity");
        note_dropped(context_.report, triangulator_.dropped_faces(), "face with fewer than 3 corners");
        note_dropped(context_.report, triangulator_.dropped_triangles(),
                     "triangle that names a vertex twice");
        Scene scene;
        scene.objects.emplace_back();
        if (!mesh_.colors.empty()) scene.objects[0].material.base = {1, 1, 1};
        scene.objects[0].mesh = std::move(mesh_);
        return scene;
    }

    Words words_;
    Context& context_;
    bool has_texture_ = false, has_colors_ = false, has_normals_ = false;
    std::size_t vertex_count_ = 0, face_count_ = 0, face_colors_ = 0, opacities_ = 0;
    Mesh mesh_;
    std::vector<std::uint32_t> corners_;
    Triangulator triangulator_;
};

}  // namespace

Result<Scene> read_off(std::string_view bytes, Context& context) { return OffReader(bytes, context).read(); }

}  // namespace frep::reading
