// The header of a PLY file (private to io): G. Turk, The PLY Polygon File Format, 1994.
// Tested by tests/unit/io/read_ply_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "frep/base/result.h"

namespace frep::reading {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a number of this type.
std::size_t ply_size(PlyType type);

struct PlyProperty {
    std::string_view name;
    PlyType type = PlyType::float32;  ///< of the number, or of the items of a list
    bool is_list = false;
    PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
    std::string_view name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;

    /// The least number of bytes that one of them takes in the file.
    std::size_t least_bytes(bool text) const;
};

struct PlyHeader {
    enum class Encoding : std::uint8_t { text, little_endian, big_endian };
    Encoding encoding = Encoding::text;
    std::vector<PlyElement> elements;
    std::size_t body = 0;       ///< where the data begin
    std::size_t body_line = 1;  ///< and the number of that line
};

/// The header at the start of `bytes`; names refer to them. Counts are as stated, believed by nobody. Errors:
/// io with the line.
Result<PlyHeader> read_ply_header(std::string_view bytes);

}  // namespace frep::reading
