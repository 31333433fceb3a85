// What the command writes: the result on standard output; messages, warnings and progress on standard error.
// Control bytes of files and arguments are escaped before they are printed. Tested by tests/cli.
#pragma once

#include <string_view>

#include "frep/frep.h"

namespace frep::cli {

/// How messages look; set once from the options.
struct Voice {
    bool quiet = false;  ///< errors only
    bool color = false;  ///< ANSI colors on standard error
};
Voice& voice();

/// Decides about color: `when` is auto, always or never (already checked).
void set_color(std::string_view when);

/// One line each on standard error, the text escaped: `error: text`, `warning: text`, `note: text`,
/// `help: text`. All but errors and their help are silent under --quiet.
void print_error(std::string_view text);
void print_help_line(std::string_view text);
void print_warning(std::string_view text);
void print_note(std::string_view text);
/// A line of summary without a prefix; silent under --quiet.
void print_summary(std::string_view text);

/// Prints an Error of the library and gives its exit code.
int fail(const Error& error);
/// Prints `text` as an error of usage and gives exit code 2.
int usage_error(std::string_view text);

/// At most 20 findings in rustc's shape; under --quiet errors only.
void print_diagnostics(const Diagnostics& diagnostics, const Source& source);
/// A finding that has no code: its first line is `warning: message`.
void print_uncoded(const Diagnostic& diagnostic, const Source& source);

/// Writes bytes to standard output as they are. Errors: io.
Status write_stdout(std::string_view bytes);
/// The same, and 0 or the exit code of the failure, which is then printed.
int print_result(std::string_view bytes);

/// A progress bar on standard error, drawn only on a terminal and only after a second. Clears itself.
class ProgressBar {
  public:
    explicit ProgressBar(std::string_view label);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    /// `share` of the work is done, 0..1; with the time that is left, if it is known (>= 0). Called from one
    /// thread at a time.
    void update(double share, double seconds_left = -1);

  private:
    std::string_view label_;
    bool enabled_ = false;
    double start_ = 0;
    double drawn_ = 0;
};

/// Seconds of a clock that never goes back.
double now_seconds();

}  // namespace frep::cli
