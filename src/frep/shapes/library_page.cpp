#include "frep/shapes/library_page.h"

#include <fmt/format.h>

namespace frep::shapes {
namespace {

constexpr std::string_view introduction =
    "# The function library\n\n"
    "This page is made from the library table (`src/frep/shapes`); `frep info --library` prints the same "
    "facts. A shape\n"
    "is where the value is >= 0. Unless a name begins with `hfD`, values are not distances. Arrays are "
    "passed by name;\n"
    "`&` marks an array that the function changes in place. A function answers -1111111111111 for wrong "
    "array sizes or\n"
    "degenerate arguments, as the old tools do, with a warning where that is known before evaluation. "
    "Functions marked\n"
    "*new* are not in the old library: a model's own names may stand in their place. Sources are keys of\n"
    "[bibliography.md](bibliography.md).\n";

/// Text that may stand in a Markdown table or paragraph.
std::string escaped(std::string_view text) {
    std::string out;
    for (char c : text) {
        if (c == '|' || c == '*' || c == '_' || c == '<') out += '\\';
        out += c;
    }
    return out;
}

std::string entry(const LibraryFunction& f) {
    std::string out = fmt::format("### {}\n\n`{}`{}\n\n{}\n", f.name, signature(f),
                                  f.reserved ? "" : " *new*", escaped(f.doc));
    if (!f.formula.empty()) out += fmt::format("\n    {}\n", f.formula);
    if (!f.note.empty()) out += fmt::format("\nNote: {}\n", escaped(f.note));
    if (!f.citation.empty()) out += fmt::format("\nSource: {}.\n", f.citation);
    return out + "\n";
}

}  // namespace

std::string signature(const LibraryFunction& function) {
    std::string out(function.name);
    out += '(';
    for (const ArgumentInfo& argument : function.arguments) {
        if (out.back() != '(') out += ", ";
        if (argument.kind == ArgumentKind::array_in_out) out += '&';
        out += argument.name;
    }
    return out + ')';
}

std::string library_page() {
    std::string out(introduction);
    std::string_view group;
    for (const LibraryFunction& f : library()) {
        if (f.group != group) out += fmt::format("\n## {}\n\n", f.group);
        group = f.group;
        out += entry(f);
    }
    while (out.ends_with("\n\n")) out.pop_back();
    return out;
}

}  // namespace frep::shapes
