// Names and texts inside files (private to io): cleaned of what no format allows, escaped for the syntax,
// or reduced to an identifier. Tested by tests/unit/io/write_text_test.cpp.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace frep::encode {

/// `text` as valid UTF-8 on one line: tabs and line ends become blanks; other control characters (C0, DEL,
/// C1) and U+FFFE, U+FFFF, which XML forbids, are dropped.
std::string clean_text(std::string_view text);

/// Appends the cleaned text for XML, in an element or an attribute: & < > " ' become entities.
void append_xml(std::string& out, std::string_view text);

/// Appends the cleaned text in double quotes, with \" and \\ inside: a string of JSON and of VRML.
void append_quoted(std::string& out, std::string_view text);

/// `text` reduced to ASCII letters, digits and _: one _ for each run of other characters, 60 characters at
/// most; `prefix` stands before what does not begin with a letter.
std::string identifier(std::string_view text, std::string_view prefix);

/// The cleaned text as one word for Wavefront files: blanks and # become _.
std::string word(std::string_view text, std::string_view when_empty);

/// Makes names different by numbers at their end.
class UniqueNames {
  public:
    /// `name`, or the first of name_2, name_3, ... that was not given out before.
    std::string unique(const std::string& name);

  private:
    std::set<std::string> taken_;
};

}  // namespace frep::encode
