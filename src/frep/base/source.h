// A model's text and places in it. Text is decoded once here: bytes that are not UTF-8 (Shift-JIS and
// Latin-1 comments of the 1990s) become U+FFFD, so that everything above handles valid UTF-8 only.
// Tested by tests/unit/base/source_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace frep {

/// A range of bytes of a Source: [begin, end).
struct Span {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    bool operator==(const Span&) const = default;
};

/// The span from the start of `a` to the end of `b`.
inline Span join(Span a, Span b) {
    return {a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

/// A place for people: line and column start at 1, columns count code points.
struct LineColumn {
    std::uint32_t line = 1;
    std::uint32_t column = 1;
};

/// A named text with an index of its lines. LF, CR LF and a lone CR each end a line.
class Source {
  public:
    Source() = default;
    /// `bytes` as read from a file; a UTF-8 byte order mark is dropped, bad bytes become U+FFFD.
    Source(std::string name, std::string_view bytes);

    const std::string& name() const { return name_; }
    std::string_view text() const { return text_; }
    std::string_view text(Span span) const { return text().substr(span.begin, span.end - span.begin); }
    LineColumn locate(std::uint32_t offset) const;
    /// The line (1-based) without its end-of-line characters; empty when out of range.
    std::string_view line(std::uint32_t number) const;
    std::uint32_t line_count() const { return static_cast<std::uint32_t>(line_starts_.size()); }

  private:
    std::string name_;
    std::string text_;
    std::vector<std::uint32_t> line_starts_{0};
};

/// `bytes` with every ill-formed UTF-8 sequence replaced by U+FFFD.
std::string to_valid_utf8(std::string_view bytes);

/// `text` with ASCII letters in lower case; names of models and options compare so (docs/numerics.md, rule
/// 12).
std::string lower_case(std::string_view text);

/// `text` with control characters shown as \xNN (tab as one blank), and characters that turn the direction of
/// text as \u20NN, so that a terminal is never sent one.
std::string escape_controls(std::string_view text);

}  // namespace frep
