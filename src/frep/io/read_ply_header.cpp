// Implementation of read_ply_header.h.
#include "frep/io/read_ply_header.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "frep/io/read_formats.h"

namespace frep::reading {

namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};
constexpr std::array type_names{TypeName{"char", PlyType::int8},      TypeName{"int8", PlyType::int8},
                                TypeName{"uchar", PlyType::uint8},    TypeName{"uint8", PlyType::uint8},
                                TypeName{"short", PlyType::int16},    TypeName{"int16", PlyType::int16},
                                TypeName{"ushort", PlyType::uint16},  TypeName{"uint16", PlyType::uint16},
                                TypeName{"int", PlyType::int32},      TypeName{"int32", PlyType::int32},
                                TypeName{"uint", PlyType::uint32},    TypeName{"uint32", PlyType::uint32},
                                TypeName{"float", PlyType::float32},  TypeName{"float32", PlyType::float32},
                                TypeName{"double", PlyType::float64}, TypeName{"float64", PlyType::float64}};

std::optional<PlyType> type_of(std::string_view word) {
    for (const TypeName& known : type_names)
        if (word == known.name) return known.type;
    return std::nullopt;
}

class HeaderReader {
  public:
    explicit HeaderReader(std::string_view bytes) : bytes_(bytes), words_(bytes) {}

    Result<PlyHeader> read() {
        std::string_view word;
        if (!words_.next_in_line(word) || word != "ply") return malformed_line(1, "expected ply");
        bool encoded = false;
        while (words_.next_line()) {
            if (!words_.next_in_line(word)) continue;
            if (word == "end_header") return finish(encoded);
            if (word == "comment" || word == "obj_info") continue;
            Status status;
            if (word == "format") {
                status = read_format();
                encoded = true;
            } else if (word == "element") {
                status = read_element();
            } else if (word == "property") {
                status = read_property();
            } else {
                status = error(fmt::format("{} is not known in a header", quoted(word)));
            }
            if (!status) return status.error();
        }
        return error("the header has no end_header");
    }

  private:
    Error error(std::string_view message) const { return malformed_line(words_.line(), message); }

    Result<PlyHeader> finish(bool encoded) {
        if (!encoded) return error("the header has no line format");
        if (!words_.next_line() && words_.remaining() > 0) return error("end_header has no end of line");
        header_.body = bytes_.size() - words_.remaining();
        header_.body_line = words_.line();
        return std::move(header_);
    }

    Status read_format() {
        std::string_view word, version;
        const bool complete = words_.next_in_line(word) && words_.next_in_line(version);
        if (!complete || version != "1.0") return error("expected a format and its version 1.0");
        if (word == "ascii") {
            header_.encoding = PlyHeader::Encoding::text;
        } else if (word == "binary_little_endian") {
            header_.encoding = PlyHeader::Encoding::little_endian;
        } else if (word == "binary_big_endian") {
            header_.encoding = PlyHeader::Encoding::big_endian;
        } else {
            return error(fmt::format("{} is no format of PLY", quoted(word)));
        }
        return {};
    }

    Status read_element() {
        std::string_view name, count;
        if (!words_.next_in_line(name) || !words_.next_in_line(count))
            return error("expected the name and number of an element");
        const auto number = parse_integer(count);
        if (!number || *number < 0 || *number > 0xffffffff)
            return error(fmt::format("{} is no number of elements", quoted(count)));
        header_.elements.push_back({name, static_cast<std::size_t>(*number), {}});
        return {};
    }

    Status read_property() {
        if (header_.elements.empty()) return error("a property stands before the first element");
        PlyProperty property;
        std::string_view word;
        if (!words_.next_in_line(word)) return error("expected the type of a property");
        if (word == "list") {
            property.is_list = true;
            if (!words_.next_in_line(word)) return error("expected the type of a list's length");
            const auto count_type = type_of(word);
            if (!count_type || *count_type == PlyType::float32 || *count_type == PlyType::float64)
                return error(fmt::format("{} is no type of a list's length", quoted(word)));
            property.count_type = *count_type;
            if (!words_.next_in_line(word)) return error("expected the type of a list's items");
        }
        const auto type = type_of(word);
        if (!type) return error(fmt::format("{} is no type of a property", quoted(word)));
        property.type = *type;
        if (!words_.next_in_line(property.name)) return error("expected the name of a property");
        header_.elements.back().properties.push_back(property);
        return {};
    }

    std::string_view bytes_;
    Words words_;
    PlyHeader header_;
};

}  // namespace

std::size_t ply_size(PlyType type) {
    constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::least_bytes(bool text) const {
    std::size_t sum = 0;
    for (const PlyProperty& p : properties) sum += text ? 2 : ply_size(p.is_list ? p.count_type : p.type);
    return sum;
}

Result<PlyHeader> read_ply_header(std::string_view bytes) { return HeaderReader(bytes).read(); }

}  // namespace frep::reading
