// PLY 1.0 (G. Turk, The PLY Polygon File Format, 1994): vertices with normals and colors, faces, triangle
// strips; other elements and properties are read over. Integer colors of 16 bits are divided by 65535, other
// integers by 255. Tested by tests/unit/io/read_ply_test.cpp.
#include <fmt/format.h>

#include <array>

#include "frep/io/read_formats.h"
#include "frep/io/read_ply_header.h"
#include "frep/io/read_polygon.h"

namespace frep::reading {

namespace {

using Encoding = PlyHeader::Encoding;

/// The numbers of the body, one after the other.
class Numbers {
  public:
    Numbers(std::string_view bytes, const PlyHeader& header)
        : bytes_(bytes),
          at_(header.body),
          text_(header.encoding == Encoding::text),
          big_endian_(header.encoding == Encoding::big_endian),
          words_(bytes.substr(header.body), false, false, header.body_line) {}

    bool next(PlyType type, double& value) {
        if (text_) return next_word(type, value);
        const std::size_t size = ply_size(type);
        if (size > bytes_.size() - at_) return false;
        value = decode(bytes_.data() + at_, type);
        at_ += size;
        return true;
    }

    bool skip(PlyType type, std::size_t count) {
        if (!text_) {
            if (count > (bytes_.size() - at_) / ply_size(type)) return false;
            at_ += count * ply_size(type);
            return true;
        }
        std::string_view word;
        for (std::size_t i = 0; i < count; ++i)
            if (!words_.next(word)) return false;
        return true;
    }

    /// The length of a list whose items the rest of the file can hold.
    bool next_length(const PlyProperty& list, std::size_t& length) {
        double value = 0;
        if (!next(list.count_type, value) || !(value >= 0)) return false;
        const double room = text_ ? static_cast<double>(words_.remaining()) / 2 + 1
                                  : static_cast<double>((bytes_.size() - at_) / ply_size(list.type));
        if (value > room) return false;
        length = static_cast<std::size_t>(value);
        return true;
    }

    std::size_t remaining() const { return text_ ? words_.remaining() : bytes_.size() - at_; }
    Error error(std::string_view message) const {
        return text_ ? malformed_line(words_.line(), message) : malformed_byte(at_, message);
    }
    bool at_end() {
        std::string_view word;
        return text_ ? !words_.next(word) : at_ == bytes_.size();
    }

  private:
    bool next_word(PlyType type, double& value) {
        std::string_view word;
        if (!words_.next(word)) return false;
        if (type == PlyType::float32) {
            const auto number = parse_number<float>(word);
            if (number) value = static_cast<double>(*number);
            return number.has_value();
        }
        const auto number = parse_number<double>(word);
        if (number) value = *number;
        return number.has_value();
    }

    double decode(const char* data, PlyType type) const {
        switch (type) {
            case PlyType::int8:
                return static_cast<std::int8_t>(load<std::uint8_t>(data));
            case PlyType::uint8:
                return load<std::uint8_t>(data);
            case PlyType::int16:
                return static_cast<std::int16_t>(load<std::uint16_t>(data, big_endian_));
            case PlyType::uint16:
                return load<std::uint16_t>(data, big_endian_);
            case PlyType::int32:
                return static_cast<std::int32_t>(load<std::uint32_t>(data, big_endian_));
            case PlyType::uint32:
                return load<std::uint32_t>(data, big_endian_);
            case PlyType::float32:
                return static_cast<double>(load_float(data, big_endian_));
            case PlyType::float64:
                break;
        }
        return std::bit_cast<double>(load<std::uint64_t>(data, big_endian_));
    }

    std::string_view bytes_;
    std::size_t at_;
    bool text_, big_endian_;
    Words words_;
};

constexpr int no_slot = -1;

/// Which of x y z nx ny nz r g b a property is.
int slot_of(std::string_view name) {
    constexpr std::array<std::string_view, 9> names{"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue"};
    constexpr std::array<std::string_view, 3> other{"r", "g", "b"},
        diffuse{"diffuse_red", "diffuse_green", "diffuse_blue"};
    for (std::size_t i = 0; i < names.size(); ++i)
        if (name == names[i]) return static_cast<int>(i);
    for (std::size_t i = 0; i < 3; ++i)
        if (name == other[i] || name == diffuse[i]) return static_cast<int>(i + 6);
    return no_slot;
}

/// What the components of a color of this type are divided by.
double color_scale(PlyType type) {
    if (type == PlyType::float32 || type == PlyType::float64) return 1;
    return type == PlyType::uint16 || type == PlyType::int16 ? 65535 : 255;
}

double clamped(double value) { return value > 0 ? (value < 1 ? value : 1) : 0; }

class PlyReader {
  public:
    PlyReader(std::string_view bytes, const PlyHeader& header, Context& context)
        : header_(header), numbers_(bytes, header), context_(context) {}

    Result<Scene> read() {
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty()) continue;
            const std::size_t least = element.least_bytes(header_.encoding == Encoding::text);
            if (element.count > numbers_.remaining() / least + 1)
                return numbers_.error(fmt::format("the file is too short for {} elements {}", element.count,
                                                  quoted(element.name)));
            if (const Status status = read_element(element); !status) return status.error();
        }
        if (!numbers_.at_end()) return numbers_.error("data stand after the last element");
        if (const Status status = make_triangles(); !status) return status.error();
        report();
        Scene scene;
        scene.objects.emplace_back();
        if (!mesh_.colors.empty()) scene.objects[0].material.base = {1, 1, 1};
        scene.objects[0].mesh = std::move(mesh_);
        return scene;
    }

  private:
    Status read_element(const PlyElement& element) {
        if (element.name == "vertex") return read_vertices(element);
        if (element.name == "face" || element.name == "tristrips") return read_faces(element);
        note_dropped(context_.report, element.count, fmt::format("{} element", quoted(element.name)));
        for (std::size_t i = 0; i < element.count; ++i)
            for (const PlyProperty& property : element.properties)
                if (const Status status = skip(element, i, property); !status) return status;
        return {};
    }

    Error bad_number(const PlyElement& element, std::size_t index, const PlyProperty& property) const {
        return numbers_.error(fmt::format("element {} number {}: {} is missing or no number{}",
                                          quoted(element.name), index, quoted(property.name),
                                          property.is_list ? ", or the list is longer than the file" : ""));
    }

    Status skip(const PlyElement& element, std::size_t index, const PlyProperty& property) {
        std::size_t length = 1;
        if (property.is_list && !numbers_.next_length(property, length))
            return bad_number(element, index, property);
        if (!numbers_.skip(property.type, length)) return bad_number(element, index, property);
        return {};
    }

    Status read_vertices(const PlyElement& element) {
        if (have_vertices_) return numbers_.error("a second element `vertex`");
        have_vertices_ = true;
        std::vector<int> slots;
        std::array<bool, 9> has{};
        std::array<double, 3> scale{1, 1, 1};
        std::size_t unknown = 0;
        for (const PlyProperty& property : element.properties) {
            int slot = property.is_list ? no_slot : slot_of(property.name);
            if (slot != no_slot && has[static_cast<std::size_t>(slot)]) slot = no_slot;
            if (slot >= 6) scale[static_cast<std::size_t>(slot - 6)] = color_scale(property.type);
            if (slot != no_slot) has[static_cast<std::size_t>(slot)] = true;
            unknown += slot == no_slot;
            slots.push_back(slot);
        }
        if (!has[0] || !has[1] || !has[2]) return numbers_.error("the vertices have no x, y and z");
        const bool normals = has[3] && has[4] && has[5], colors = has[6] && has[7] && has[8];
        note_dropped(context_.report, unknown, "property of the vertices beyond position, normal and color");
        for (std::size_t i = 0; i < element.count; ++i) {
            std::array<double, 9> v{};
            for (std::size_t k = 0; k < slots.size(); ++k) {
                const PlyProperty& property = element.properties[k];
                if (slots[k] == no_slot) {
                    if (const Status status = skip(element, i, property); !status) return status;
                } else if (!numbers_.next(property.type, v[static_cast<std::size_t>(slots[k])])) {
                    return bad_number(element, i, property);
                }
            }
            const Vec3 p{v[0], v[1], v[2]};
            if (!is_finite(p))
                return numbers_.error(fmt::format("vertex {} has a coordinate that is not finite", i));
            mesh_.vertices.push_back(p);
            if (normals) mesh_.normals.push_back({v[3], v[4], v[5]});
            if (colors)
                mesh_.colors.push_back(
                    {clamped(v[6] / scale[0]), clamped(v[7] / scale[1]), clamped(v[8] / scale[2])});
        }
        return {};
    }

    /// Corners are kept until all vertices are known: a length, then the corners.
    Status read_faces(const PlyElement& element) {
        const bool strips = element.name == "tristrips";
        std::size_t list = element.properties.size(), unknown = 0;
        for (std::size_t k = 0; k < element.properties.size(); ++k) {
            const PlyProperty& property = element.properties[k];
            const bool wanted =
                property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
            if (wanted && list == element.properties.size()) {
                list = k;
            } else {
                ++unknown;
            }
        }
        if (list == element.properties.size())
            return numbers_.error(fmt::format("element {} has no list vertex_indices", quoted(element.name)));
        note_dropped(context_.report, unknown, "further property of the faces");
        for (std::size_t i = 0; i < element.count; ++i)
            for (std::size_t k = 0; k < element.properties.size(); ++k) {
                const PlyProperty& property = element.properties[k];
                const Status status =
                    k != list ? skip(element, i, property) : read_corners(element, i, property, strips);
                if (!status) return status;
            }
        return {};
    }

    Status read_corners(const PlyElement& element, std::size_t index, const PlyProperty& property,
                        bool strips) {
        std::size_t length = 0;
        if (!numbers_.next_length(property, length)) return bad_number(element, index, property);
        corners_.clear();
        for (std::size_t i = 0; i < length; ++i) {
            double value = 0;
            if (!numbers_.next(property.type, value)) return bad_number(element, index, property);
            if (strips && value == -1) {
                store_strip();
                continue;
            }
            if (!(value >= 0 && value < 4294967295.0) ||
                value != static_cast<double>(static_cast<std::uint32_t>(value)))
                return numbers_.error(
                    fmt::format("element {} number {} names vertex {}", quoted(element.name), index, value));
            corners_.push_back(static_cast<std::uint32_t>(value));
        }
        if (strips) {
            store_strip();
        } else {
            store_face(corners_);
        }
        return {};
    }

    void store_face(std::span<const std::uint32_t> corners) {
        faces_.push_back(static_cast<std::uint32_t>(corners.size()));
        faces_.insert(faces_.end(), corners.begin(), corners.end());
    }

    /// Every second triangle of a strip is turned round. Triangles without area join strips; they are left
    /// out.
    void store_strip() {
        for (std::size_t i = 0; i + 2 < corners_.size(); ++i) {
            const std::uint32_t a = corners_[i], b = corners_[i + 1], c = corners_[i + 2];
            if (a == b || b == c || c == a) continue;
            const std::array<std::uint32_t, 3> face = i % 2 == 0 ? std::array{a, b, c} : std::array{b, a, c};
            store_face(face);
        }
        corners_.clear();
    }

    Status make_triangles() {
        std::size_t face = 0;
        for (std::size_t at = 0; at < faces_.size(); at += 1 + faces_[at], ++face) {
            const std::span<const std::uint32_t> corners(faces_.data() + at + 1, faces_[at]);
            for (const std::uint32_t corner : corners)
                if (corner >= mesh_.vertices.size())
                    return Error{ErrorKind::io, fmt::format("face {} (from 0) names vertex {}; there are {}",
                                                            face, corner, mesh_.vertices.size())};
            triangulator_.add(mesh_.vertices, corners, mesh_.triangles);
        }
        return {};
    }

    void report() {
        note_dropped(context_.report, triangulator_.dropped_faces(), "face with fewer than 3 corners");
        note_dropped(context_.report, triangulator_.dropped_triangles(),
                     "triangle that names a vertex twice");
    }

    const PlyHeader& header_;
    Numbers numbers_;
    Context& context_;
    Mesh mesh_;
    bool have_vertices_ = false;
    std::vector<std::uint32_t> corners_, faces_;
    Triangulator triangulator_;
};

}  // namespace

Result<Scene> read_ply(std::string_view bytes, Context& context) {
    const auto header = read_ply_header(bytes);
    if (!header) return header.error();
    return PlyReader(bytes, *header, context).read();
}

}  // namespace frep::reading
