#include "frep/shapes/library_page.h"

#include <algorithm>

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
    "[bibliography.md](bibliography.md). The examples are the files of `examples/library/`; "
    "`scripts/gallery` makes\n"
    "their pictures.\n";

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

/// The picture and the text of an example, without the lines of annotations.
std::string shown_example(std::string_view name, std::string_view text) {
    std::string body;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        if (!text.starts_with("--@")) body += text.substr(0, end);
        text.remove_prefix(end);
    }
    return fmt::format("![{0}](library/{0}.png)\n\n```\n{1}```\n\n", name, body);
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

std::string library_page(const std::function<std::string(std::string_view name)>& example) {
    std::string out(introduction);
    std::string_view group, name;
    for (const LibraryFunction& f : library()) {
        if (f.group != group) out += fmt::format("\n## {}\n\n", f.group);
        out += entry(f);
        const std::string text = f.name == name ? "" : example(f.name);
        if (!text.empty()) out += shown_example(f.name, text);
        group = f.group;
        name = f.name;
    }
    while (out.ends_with("\n\n")) out.pop_back();
    return out;
}

}  // namespace frep::shapes
