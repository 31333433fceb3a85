// Implementation of terminal.h. Standard output is written with write(2) only, standard error as whole lines,
// so that nothing is left in a buffer when the watcher of budget.h ends the process.
#include "terminal.h"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "budget.h"
#include "verbs.h"

namespace frep::cli {

namespace {

constexpr std::string_view red = "1;31", yellow = "1;33", cyan = "1;36";

/// Writes everything; 0 or the error number.
int write_all(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(fd, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(done));
    }
    return 0;
}

void write_stderr(std::string_view bytes) { static_cast<void>(write_all(STDERR_FILENO, bytes)); }

/// `text` fit for a terminal, line by line: line ends stay, every other control character is escaped.
std::string escaped_lines(std::string_view text) {
    std::string out;
    for (std::size_t begin = 0; begin <= text.size();) {
        std::size_t end = text.find('\n', begin);
        if (end == std::string_view::npos) end = text.size();
        out += escape_controls(to_valid_utf8(text.substr(begin, end - begin)));
        if (end < text.size()) out += '\n';
        begin = end + 1;
    }
    return out;
}

void print_line(std::string_view word, std::string_view color, std::string_view text) {
    const std::string body = escaped_lines(text);
    if (voice().color) {
        write_stderr(fmt::format("\x1b[{}m{}\x1b[0m: {}\n", color, word, body));
    } else {
        write_stderr(fmt::format("{}: {}\n", word, body));
    }
}

}  // namespace

Voice& voice() {
    static Voice the_voice;
    return the_voice;
}

void set_color(std::string_view when) {
    const char* no_color = std::getenv("NO_COLOR");
    const char* term = std::getenv("TERM");
    const bool wanted = (!no_color || !*no_color) && (!term || std::string_view(term) != "dumb");
    voice().color = when == "always" || (when != "never" && wanted && ::isatty(STDERR_FILENO) == 1);
}

void print_error(std::string_view text) { print_line("error", red, text); }
void print_help_line(std::string_view text) { print_line("help", cyan, text); }
void print_warning(std::string_view text) {
    if (!voice().quiet) print_line("warning", yellow, text);
}
void print_note(std::string_view text) {
    if (!voice().quiet) print_line("note", cyan, text);
}
void print_summary(std::string_view text) {
    if (!voice().quiet) write_stderr(escaped_lines(text) + "\n");
}

int fail(const Error& error) {
    print_error(error.message);
    switch (error.kind) {
        case ErrorKind::invalid_model:
            return exit_invalid_model;
        case ErrorKind::invalid_argument:
            return exit_usage;
        case ErrorKind::io:
            return exit_io;
        case ErrorKind::over_limit:
            return exit_over_limit;
        case ErrorKind::cancelled:
            return exit_interrupted;
    }
    return exit_usage;
}

int usage_error(std::string_view text) { return fail({ErrorKind::invalid_argument, std::string(text)}); }

void print_diagnostics(const Diagnostics& diagnostics, const Source& source) {
    RenderOptions options;
    options.color = voice().color;
    if (!voice().quiet) return write_stderr(render(diagnostics, source, options));
    Diagnostics errors;
    for (const Diagnostic& d : diagnostics.list())
        if (d.severity == Severity::error) errors.add(d);
    write_stderr(render(errors, source, options));
}

void print_uncoded(const Diagnostic& diagnostic, const Source& source) {
    if (voice().quiet && diagnostic.severity != Severity::error) return;
    Diagnostics list;
    list.add(diagnostic);
    RenderOptions options;
    options.color = voice().color;
    write_stderr(render(list, source, options));
}

Status write_stdout(std::string_view bytes) {
    if (const int code = write_all(STDOUT_FILENO, bytes))
        return Error{ErrorKind::io,
                     "cannot write to standard output: " + std::generic_category().message(code)};
    return {};
}

int print_result(std::string_view bytes) {
    const Status status = write_stdout(bytes);
    return status ? int{exit_ok} : fail(status.error());
}

double now_seconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

ProgressBar::ProgressBar(std::string_view label)
    : label_(label), enabled_(!voice().quiet && ::isatty(STDERR_FILENO) == 1), start_(now_seconds()) {}

ProgressBar::~ProgressBar() {
    if (drawn_ == 0) return;
    bar_on_screen(false);
    write_stderr("\r\x1b[K");
}

void ProgressBar::update(double share, double seconds_left) {
    if (!enabled_) return;
    const double now = now_seconds();
    if (now - start_ < 1 || now - drawn_ < 0.1) return;
    drawn_ = now;
    constexpr int width = 30;
    const int full = static_cast<int>(share * width);
    std::string bar(static_cast<std::size_t>(full < 0 ? 0 : full > width ? width : full), '#');
    bar.resize(width, '.');
    bar_on_screen(true);
    std::string left;
    if (seconds_left >= 0) {
        const auto whole = static_cast<long>(seconds_left + 0.5);
        left = whole < 60 ? fmt::format(", {} s left ", whole)
                          : fmt::format(", {}:{:02} min left ", whole / 60, whole % 60);
    }
    write_stderr(fmt::format("\r{} [{}] {:3.0f}%{}", label_, bar, share * 100, left));
}

}  // namespace frep::cli
