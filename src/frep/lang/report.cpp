// Keeping, limiting and quoting of findings; see report.h. Tested by tests/unit/lang/parser_test.cpp.
#include "frep/lang/report.h"

#include <algorithm>

#include <fmt/format.h>

#include "frep/lang/limits.h"

namespace frep::lang {
namespace {

// Half of the limit each, less two places for the notes of finish().
constexpr std::size_t errors_kept = diagnostic_limit / 2 - 2;
constexpr std::size_t warnings_kept = diagnostic_limit / 2;
constexpr std::size_t quote_limit = 60;  // bytes

}  // namespace

std::string Reporter::quote(std::string_view text) {
    bool clipped = false;
    if (text.size() > quote_limit) {
        std::size_t end = quote_limit;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
        text = text.substr(0, end);
        clipped = true;
    }
    return fmt::format("`{}{}`", escape_controls(text), clipped ? "..." : "");
}

void Reporter::report(Code code, Span span, Words words) {
    switch (info(code).severity) {
        case Severity::error:
            return error(code, span, std::move(words));
        case Severity::warning:
            return warning(code, span, std::move(words));
        case Severity::note:
            if (!stopped_) keep(Severity::note, code, span, std::move(words));
    }
}

void Reporter::error(Code code, Span span, Words words) {
    if (stopped_) return;
    keep(Severity::error, code, span, std::move(words));
    if (++errors_ >= errors_kept) stopped_ = too_many_errors_ = true;
}

void Reporter::warning(Code code, Span span, Words words) {
    if (stopped_) return;
    if (warnings_ >= warnings_kept)
        ++dropped_warnings_;
    else
        keep(Severity::warning, code, span, std::move(words));
    ++warnings_;
}

void Reporter::fatal(Code code, Span span, Words words) {
    error(code, span, std::move(words));
    stopped_ = true;
}

void Reporter::keep(Severity severity, Code code, Span span, Words words) {
    kept_.push_back({severity, std::string(info(code).code), std::move(words.message), span,
                     std::move(words.label), std::move(words.help)});
}

void Reporter::finish(Diagnostics& out) {
    std::stable_sort(kept_.begin(), kept_.end(),
                     [](const auto& a, const auto& b) { return a.span.begin < b.span.begin; });
    const Span last = kept_.empty() ? Span{} : kept_.back().span;
    for (Diagnostic& diagnostic : kept_) out.add(std::move(diagnostic));
    kept_.clear();
    const auto note = [&](std::string message) {
        out.add({Severity::note,
                 std::string(info(Code::too_many_diagnostics).code),
                 std::move(message),
                 last,
                 {},
                 "mend the first ones; the rest often follows from them"});
    };
    if (too_many_errors_) note(fmt::format("stopped reading after {} errors", errors_));
    if (dropped_warnings_ > 0) note(fmt::format("{} more warnings are not shown", dropped_warnings_));
}

}  // namespace frep::lang
