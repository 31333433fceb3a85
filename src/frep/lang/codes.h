// The codes of the language's diagnostics. The table diagnostics.def is their only source: the enumeration
// below, the texts of `frep explain` and the tests of every code's example come from it. Tested by
// tests/unit/lang/explain_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "frep/base/diagnostic.h"

namespace frep::lang {

/// A row of diagnostics.def. HF001..HF099 come from parse(), HF101..HF199 from
/// lowering, HF201..HF249 from parse_vm_text().
enum class Code : std::uint8_t {
#define FREP_DIAGNOSTIC(code, name, severity, proof, title, text, wrong, right) name,
#include "frep/lang/diagnostics.def"
#undef FREP_DIAGNOSTIC
};

/// How the example of a row is tested.
enum class Proof : std::uint8_t {
    example,    ///< parse(wrong) gives the code, parse(right) gives nothing
    generated,  ///< the text is too large for a table: explain_test.cpp makes it
    lowering,   ///< the code comes from lowering, tested with it
    vm_text,    ///< parse_vm_text(wrong) gives the code, parse_vm_text(right) gives nothing
    advice,     ///< Model::advise() gives the code for the lowered wrong example, nothing for the right one
    blends,     ///< check_blends() gives the code for the wrong example, nothing for the right one
};

/// What the table says of a code.
struct CodeInfo {
    std::string_view code;  ///< "HF012": stable, printed
    std::string_view name;  ///< "expected_expression"
    Severity severity;      ///< the usual one; a few codes appear with two
    Proof proof;
    std::string_view title;  ///< a line
    std::string_view text;   ///< paragraphs
    std::string_view wrong;  ///< a file that gives the code
    std::string_view right;  ///< the same, mended
};

/// All rows, in the order of their codes.
std::span<const CodeInfo> diagnostic_table();

/// The row of `code`.
const CodeInfo& info(Code code);

}  // namespace frep::lang
