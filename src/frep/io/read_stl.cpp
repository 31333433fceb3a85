// STL (3D Systems, StereoLithography Interface Specification 1988), binary and text. Coordinates are binary32
// in both. A file is binary when its size is what its count of facets asks for, whatever it begins with; many
// binary files begin with "solid". Facet normals are not read: they follow from the corners.
// Tested by tests/unit/io/read_stl_test.cpp.
#include <fmt/format.h>

#include "frep/base/source.h"
#include "frep/io/read_formats.h"

namespace frep::reading {

namespace {

constexpr std::size_t header_bytes = 84, facet_bytes = 50;

std::uint64_t binary_size(std::string_view bytes) {
    return header_bytes + std::uint64_t{facet_bytes} * load<std::uint32_t>(bytes.data() + 80);
}

bool is_word(std::string_view word, std::string_view lower) {
    return word.size() == lower.size() && lower_case(word) == lower;
}

/// True for a file that begins with "solid" and goes on as text does.
bool looks_like_text(std::string_view bytes) {
    std::string_view word;
    if (!Words(bytes.substr(0, 200)).next(word) || !is_word(word, "solid")) return false;
    const std::string_view start = bytes.substr(0, 4096);
    if (start.find('\0') != std::string_view::npos) return false;
    const std::string lower = lower_case(start);
    return lower.find("facet") != std::string::npos || lower.find("endsolid") != std::string::npos ||
           bytes.size() < header_bytes;
}

/// The soup of triangles with equal positions as one vertex.
void add_object(std::string name, Mesh&& soup, Context& context, Scene& scene) {
    SceneObject object;
    object.name = std::move(name);
    object.mesh = merge_equal_positions(soup);
    note_dropped(context.report, soup.triangles.size() - object.mesh.triangles.size(),
                 "triangle that names a vertex twice");
    scene.objects.push_back(std::move(object));
}

void add_corner_triangle(Mesh& soup) {
    const auto n = static_cast<std::uint32_t>(soup.vertices.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
}

Result<Scene> read_binary(std::string_view bytes, Context& context) {
    const std::size_t count = load<std::uint32_t>(bytes.data() + 80);
    Mesh soup;
    soup.vertices.reserve(3 * count);
    soup.triangles.reserve(count);
    std::size_t attributes = 0;
    for (std::size_t facet = 0; facet < count; ++facet) {
        const std::size_t at = header_bytes + facet_bytes * facet;
        for (std::size_t corner = 1; corner <= 3; ++corner) {
            const char* data = bytes.data() + at + 12 * corner;
            const Vec3 p{load_float(data), load_float(data + 4), load_float(data + 8)};
            if (!is_finite(p))
                return malformed_byte(at + 12 * corner,
                                      fmt::format("facet {} has a coordinate that is not finite", facet));
            soup.vertices.push_back(p);
        }
        add_corner_triangle(soup);
        if (load<std::uint16_t>(bytes.data() + at + 48) != 0) ++attributes;
    }
    Scene scene;
    add_object("", std::move(soup), context, scene);
    note_dropped(context.report, attributes, "facet attribute");
    note_dropped(context.report, bytes.size() - (header_bytes + facet_bytes * count), "trailing byte");
    return scene;
}

class TextReader {
  public:
    TextReader(std::string_view bytes, Context& context) : words_(bytes), context_(context) {}

    Result<Scene> read() {
        Scene scene;
        std::string_view word;
        while (words_.next(word)) {
            if (!is_word(word, "solid")) return expected("solid", word);
            std::string name = object_name(words_.rest_of_line());
            auto soup = read_solid();
            if (!soup) return soup.error();
            add_object(std::move(name), std::move(*soup), context_, scene);
        }
        return scene;
    }

  private:
    Error expected(std::string_view wanted, std::string_view found) const {
        return malformed_line(words_.line(), fmt::format("expected {}, found {}", wanted, quoted(found)));
    }

    Status expect(std::string_view wanted) {
        std::string_view word;
        if (!words_.next(word)) return ended(wanted);
        if (!is_word(word, wanted)) return expected(wanted, word);
        return {};
    }
    Error ended(std::string_view wanted) const {
        return malformed_line(words_.line(), fmt::format("the file ends where {} is expected", wanted));
    }

    Result<Mesh> read_solid() {
        Mesh soup;
        std::string_view word;
        while (true) {
            if (!words_.next(word)) return ended("facet or endsolid");
            if (is_word(word, "endsolid")) break;
            if (!is_word(word, "facet")) return expected("facet or endsolid", word);
            if (const Status status = read_facet(soup); !status) return status.error();
        }
        words_.rest_of_line();
        return soup;
    }

    Status read_facet(Mesh& soup) {
        std::string_view word;
        if (const Status status = expect("normal"); !status) return status;
        for (int i = 0; i < 3; ++i)
            if (!words_.next(word)) return ended("a number");
        if (const Status status = expect("outer"); !status) return status;
        if (const Status status = expect("loop"); !status) return status;
        for (int corner = 0; corner < 3; ++corner) {
            if (const Status status = expect("vertex"); !status) return status;
            Vec3 p;
            for (double* value : {&p.x, &p.y, &p.z}) {
                if (!words_.next(word)) return ended("a number");
                const auto number = parse_number<float>(word);
                if (!number) return expected("a number", word);
                *value = static_cast<double>(*number);
                if (!is_finite(*value)) return malformed_line(words_.line(), "the coordinate is not finite");
            }
            soup.vertices.push_back(p);
        }
        add_corner_triangle(soup);
        if (const Status status = expect("endloop"); !status) return status;
        return expect("endfacet");
    }

    Words words_;
    Context& context_;
};

}  // namespace

Result<Scene> read_stl(std::string_view bytes, Context& context) {
    const bool counted = bytes.size() >= header_bytes;
    if (counted && binary_size(bytes) == bytes.size()) return read_binary(bytes, context);
    if (looks_like_text(bytes)) return TextReader(bytes, context).read();
    if (counted && binary_size(bytes) <= bytes.size()) return read_binary(bytes, context);
    if (!counted)
        return malformed_byte(bytes.size(),
                              "the file is too short for binary STL and does not begin with solid");
    return malformed_byte(
        80, fmt::format("{} facets need {} bytes, the file has {}", load<std::uint32_t>(bytes.data() + 80),
                        binary_size(bytes), bytes.size()));
}

}  // namespace frep::reading
