// The table of diagnostics and its pages; see codes.h and explain.h. Tested by
// tests/unit/lang/explain_test.cpp.
#include "frep/lang/explain.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "frep/lang/lexer.h"

namespace frep::lang {
namespace {

constexpr CodeInfo table[] = {
#define FREP_DIAGNOSTIC(code, name, severity, proof, title, text, wrong, right) \
    {code, #name, Severity::severity, Proof::proof, title, text, wrong, right},
#include "frep/lang/diagnostics.def"
#undef FREP_DIAGNOSTIC
};

/// "HF012" of "hf12", "12", "HF0012"; other texts in lower case.
std::string normalised(std::string_view code) {
    const std::string lower = lower_case(code);
    std::string_view digits = lower;
    if (digits.starts_with("hf")) digits.remove_prefix(2);
    if (digits.empty() || digits.find_first_not_of("0123456789") != digits.npos) return lower;
    while (digits.size() > 3 && digits.front() == '0') digits.remove_prefix(1);
    return fmt::format("HF{:0>3}", digits);
}

const CodeInfo* find(std::string_view code) {
    const std::string wanted = normalised(code);
    for (const CodeInfo& row : table)
        if (row.code == wanted || row.name == wanted) return &row;
    return nullptr;
}

void append_example(std::string& out, std::string_view title, std::string_view example) {
    out += fmt::format("\n{}\n\n", title);
    while (!example.empty()) {
        const std::size_t end = std::min(example.find('\n'), example.size());
        out += fmt::format("    {}\n", example.substr(0, end));
        example.remove_prefix(std::min(end + 1, example.size()));
    }
}

}  // namespace

std::span<const CodeInfo> diagnostic_table() { return table; }

const CodeInfo& info(Code code) { return table[static_cast<std::size_t>(code)]; }

Result<std::string> explain(std::string_view code) {
    const CodeInfo* row = find(code);
    if (!row) {
        std::vector<std::string_view> names;
        for (const CodeInfo& one : table) names.insert(names.end(), {one.code, one.name});
        const std::string_view near = code.size() > 2 ? nearest_name(code, names) : std::string_view{};
        return Error{ErrorKind::invalid_argument,
                     fmt::format("there is no diagnostic \"{}\"{}", escape_controls(code.substr(0, 60)),
                                 near.empty() ? "" : fmt::format("; did you mean {}?", near))};
    }
    std::string out =
        fmt::format("{} ({}): {}\n\n{}\n", row->code, to_string(row->severity), row->title, row->text);
    append_example(out, "Wrong:", row->wrong);
    append_example(out, "Right:", row->right);
    return out;
}

}  // namespace frep::lang
