// What the readers of the formats share (private to io): the calls that decode_scene() chooses from, places
// in messages, words and numbers of text, numbers of binary files. Tested by tests/unit/io/read_*_test.cpp.
#pragma once

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "frep/io/read_mesh.h"

namespace frep::reading {

struct Context {
    const ReadOptions& options;
    ReadReport& report;
};

Result<Scene> read_stl(std::string_view bytes, Context& context);
Result<Scene> read_ply(std::string_view bytes, Context& context);
Result<Scene> read_obj(std::string_view bytes, Context& context);
Result<Scene> read_off(std::string_view bytes, Context& context);
Result<Scene> read_gltf(std::string_view bytes, Context& context);

/// The materials of an MTL file by name; lines that are not understood are skipped.
struct NamedMaterial {
    std::string name;
    Material material;
};
std::vector<NamedMaterial> read_mtl(std::string_view bytes);

/// Errors of content: "line 12: message", "byte 84: message".
Error malformed_line(std::size_t line, std::string_view message);
Error malformed_byte(std::size_t offset, std::string_view message);

/// `text` for a message: at most 40 bytes of it, between backquotes.
std::string quoted(std::string_view text);

/// `text` as the name of an object: valid UTF-8, at most 200 bytes, without blanks around it.
std::string object_name(std::string_view text);

/// Adds "COUNT WHAT" to the report when count > 0 ("s" is appended for other counts than 1).
void note_dropped(ReadReport& report, std::size_t count, std::string_view what);

inline bool is_finite(double value) { return value - value == 0; }
inline bool is_finite(const Vec3& v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

/// Colors of a text file that may be in 0..1 or 0..255: divided by 255 when one component is above 1.
void scale_colors(std::vector<Color>& colors);

/// A decimal number that is the whole of `word`, a leading + allowed: nothing for anything else. Too small
/// numbers become 0, too large ones infinite; "nan" and "inf" are numbers.
template <class Number>
std::optional<Number> parse_number(std::string_view word);

extern template std::optional<double> parse_number<double>(std::string_view);
extern template std::optional<float> parse_number<float>(std::string_view);

/// A whole number that is the whole of `word`; nothing when it is none or beyond 64 bits.
inline std::optional<std::int64_t> parse_integer(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    std::int64_t value = 0;
    const auto end = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end.ec != std::errc() || end.ptr != word.data() + word.size()) return std::nullopt;
    return value;
}

/// Text as words between blanks. A line ends with LF, CR LF or a lone CR.
class Words {
  public:
    /// With `comments`, # and what follows on the line is blank; with `continued`, a backslash at the end of
    /// a line joins it with the next one.
    explicit Words(std::string_view text, bool comments = false, bool continued = false,
                   std::size_t first_line = 1)
        : text_(text), line_(first_line), comments_(comments), continued_(continued) {}

    /// The next word, on this line or a later one; false at the end of the text.
    bool next(std::string_view& word);
    /// The next word of this line; false at its end, where the place stays.
    bool next_in_line(std::string_view& word);
    /// What is left of this line without blanks around it, comments included; goes to its end.
    std::string_view rest_of_line();
    /// Goes to the start of the next line; false at the end of the text.
    bool next_line();

    /// Number of the line where the reading stands, from 1.
    std::size_t line() const { return line_; }
    std::size_t remaining() const { return text_.size() - at_; }

  private:
    bool at_line_end() const { return at_ >= text_.size() || text_[at_] == '\n' || text_[at_] == '\r'; }
    void skip_blanks();
    void skip_line_end();
    std::size_t line_end_length(std::size_t at) const;

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_;
    bool comments_, continued_;
};

/// The unsigned number of sizeof(Bits) bytes at `data`, little endian or big endian.
template <class Bits>
Bits load(const char* data, bool big_endian = false) {
    Bits value = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i) {
        const std::size_t shift = 8 * (big_endian ? sizeof(Bits) - 1 - i : i);
        value =
            static_cast<Bits>(value | static_cast<Bits>(Bits{static_cast<unsigned char>(data[i])} << shift));
    }
    return value;
}

inline float load_float(const char* data, bool big_endian = false) {
    return std::bit_cast<float>(load<std::uint32_t>(data, big_endian));
}

}  // namespace frep::reading
