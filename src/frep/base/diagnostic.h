// Diagnostics: what is wrong with a model's text, with its place. Passes collect them in a list and go on;
// only the apps print. The printed shape is rustc's (RFC 1644): code, message, place, source line, caret,
// help. Tested by tests/unit/base/diagnostic_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frep/base/source.h"

namespace frep {

enum class Severity { error, warning, note };

/// One finding. `code` is stable ("HF012"); `message` says what is wrong, `label` stands at the caret,
/// `help` says what to do (may be empty).
struct Diagnostic {
    Severity severity = Severity::error;
    std::string code;
    std::string message;
    Span span;
    std::string label;
    std::string help;
};

/// A list of findings in the order of their discovery.
class Diagnostics {
  public:
    void add(Diagnostic diagnostic) { list_.push_back(std::move(diagnostic)); }
    const std::vector<Diagnostic>& list() const { return list_; }
    bool empty() const { return list_.empty(); }
    bool has_errors() const;
    std::size_t error_count() const;
    void append(const Diagnostics& other);

  private:
    std::vector<Diagnostic> list_;
};

struct RenderOptions {
    bool color = false;         ///< ANSI colors
    std::size_t at_most = 20;   ///< diagnostics printed; the rest is counted in a last line
    std::size_t columns = 160;  ///< a quoted source line is clipped to this width around the caret
};

/// The findings as text for a terminal. Control characters of the source are shown escaped.
std::string render(const Diagnostics& diagnostics, const Source& source, const RenderOptions& options = {});

/// The word for a severity: "error", "warning", "note".
std::string_view to_string(Severity severity);

/// The candidate nearest to `name` by edit distance (Damerau-Levenshtein, ASCII case folded), or an empty
/// view when none is near enough to be worth suggesting.
std::string_view nearest_name(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace frep
