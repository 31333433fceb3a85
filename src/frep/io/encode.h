// Building blocks of the encoders (private to io): shortest numbers as text, little-endian bytes.
// Tested through tests/unit/io/mesh_format_test.cpp.
#pragma once

#include <bit>
#include <charconv>
#include <cstdint>
#include <string>

namespace frep::encode {

/// Appends the shortest decimal that reads back to `value`.
template <class Number>
void append_number(std::string& out, Number value) {
    char text[32];
    const std::to_chars_result end = std::to_chars(text, text + sizeof text, value);
    out.append(text, end.ptr);
}

/// Appends the low `count` bytes of `bits`, lowest first.
inline void append_little_endian(std::string& out, std::uint32_t bits, int count = 4) {
    for (int i = 0; i < count; ++i) out.push_back(static_cast<char>((bits >> (8 * i)) & 0xffu));
}

/// Appends `value` as binary32, little endian. Zero is written without its sign.
inline void append_float(std::string& out, double value) {
    append_little_endian(out, std::bit_cast<std::uint32_t>(static_cast<float>(value) + 0.0f));
}

}  // namespace frep::encode
