// Reporter: where the passes of the front end leave their findings. It keeps at most diagnostic_limit of
// them: too many errors stop the parser, further warnings are only counted. Quoted text is clipped and free
// of control characters (cli.md, Terminal safety). Tested by tests/unit/lang/parser_test.cpp.
#pragma once

#include <string>
#include <string_view>

#include "frep/base/diagnostic.h"
#include "frep/lang/codes.h"

namespace frep::lang {

/// The words of one finding.
struct Words {
    std::string message;
    std::string label = {};
    std::string help = {};
};

class Reporter {
  public:
    explicit Reporter(const Source& source) : source_(source) {}

    /// A finding with the table's usual severity.
    void report(Code code, Span span, Words words);
    /// The same as an error or as a warning, for codes that appear as both.
    void error(Code code, Span span, Words words);
    void warning(Code code, Span span, Words words);
    /// An error after which nothing more is read.
    void fatal(Code code, Span span, Words words);

    /// True once parsing must stop; nothing is kept from then on.
    bool stopped() const { return stopped_; }
    std::size_t errors() const { return errors_; }

    /// The source text of `span` between backticks, clipped and escaped.
    std::string quote(Span span) const { return quote(source_.text(span)); }
    static std::string quote(std::string_view text);

    const Source& source() const { return source_; }

    /// The findings in the order of their places, followed by notes on what was left out.
    void finish(Diagnostics& out);

  private:
    void keep(Severity severity, Code code, Span span, Words words);

    const Source& source_;
    std::vector<Diagnostic> kept_;
    std::size_t errors_ = 0;
    std::size_t warnings_ = 0;
    std::size_t dropped_warnings_ = 0;
    bool stopped_ = false;
    bool too_many_errors_ = false;
};

}  // namespace frep::lang
