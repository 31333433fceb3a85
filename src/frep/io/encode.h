// Building blocks of the encoders (private to io): shortest numbers as text, little-endian bytes.
// Tested through tests/unit/io/mesh_format_test.cpp.
#pragma once

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "frep/math/vec.h"

namespace frep::encode {

/// Appends the shortest decimal that reads back to `value`.
template <class Number>
void append_number(std::string& out, Number value) {
    char text[32];
    const std::to_chars_result end = std::to_chars(text, text + sizeof text, value);
    out.append(text, static_cast<std::size_t>(end.ptr - text));
}

/// Appends `value` as the shortest decimal of its binary32; zero without its sign.
inline void append_real(std::string& out, double value) {
    append_number(out, static_cast<float>(value) + 0.0f);
}

/// The same without an exponent, for formats whose readers may not know one.
inline void append_plain_real(std::string& out, double value) {
    char text[128];  // the smallest positive number of binary32 has 45 digits behind the point
    const float number = static_cast<float>(value) + 0.0f;
    const auto end = std::to_chars(text, text + sizeof text, number, std::chars_format::fixed);
    out.append(text, static_cast<std::size_t>(end.ptr - text));
}

/// Three numbers as text, binary32 if Number is float. Zeros without sign.
template <class Number>
void append_numbers(std::string& out, Vec3 v, std::string_view between = " ") {
    append_number(out, static_cast<Number>(v.x) + Number{0});
    out += between;
    append_number(out, static_cast<Number>(v.y) + Number{0});
    out += between;
    append_number(out, static_cast<Number>(v.z) + Number{0});
}

/// Appends the low `count` bytes of `bits`, lowest first.
inline void append_little_endian(std::string& out, std::uint32_t bits, int count = 4) {
    for (int i = 0; i < count; ++i) out.push_back(static_cast<char>((bits >> (8 * i)) & 0xffu));
}

/// Appends `value` as binary32, little endian. Zero is written without its sign.
inline void append_float(std::string& out, double value) {
    append_little_endian(out, std::bit_cast<std::uint32_t>(static_cast<float>(value) + 0.0f));
}

/// Appends three binary32.
inline void append_vector(std::string& out, Vec3 v) {
    append_float(out, v.x);
    append_float(out, v.y);
    append_float(out, v.z);
}

}  // namespace frep::encode
