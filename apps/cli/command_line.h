// The options of a verb: declared by name, read from the command line, listed by --help after three examples.
// Wraps CLI11, which only the implementation includes. Values arrive as text and are read by values.h, so
// that they may begin with `-` and errors name the option. Tested by tests/cli.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verbs.h"

namespace frep::cli {

/// Options that every verb has.
struct CommonOptions {
    bool quiet = false;
    std::string color = "auto";
    std::optional<std::string> time_limit;
    std::optional<std::string> memory_limit;
    std::optional<std::string> isa;
};

class CommandLine {
  public:
    /// `examples`: three lines, each a whole command. `synopsis`: what follows `frep` in the usage line.
    CommandLine(std::string_view verb, std::string_view synopsis, std::string_view doc,
                std::vector<std::string> examples);
    ~CommandLine();

    /// The one argument without a name.
    void positional(const std::string& name, std::string& target, const std::string& doc);
    /// An option with a value; `names` as in "-o,--output".
    void text(const std::string& names, std::optional<std::string>& target, const std::string& metavar,
              const std::string& doc);
    /// An option that may be given several times.
    void texts(const std::string& names, std::vector<std::string>& target, const std::string& metavar,
               const std::string& doc);
    void flag(const std::string& names, bool& target, const std::string& doc);

    /// Reads the arguments and applies the common options. Gives an exit code when the verb is done with
    /// that: after --help, or an error, which is then printed.
    std::optional<int> parse(Arguments arguments);

    /// The value of --memory-limit in bytes, after parse().
    std::optional<std::size_t> memory_limit() const { return memory_bytes_; }
    /// The value of --time-limit in seconds, after parse().
    std::optional<double> time_limit() const { return time_seconds_; }

  private:
    std::optional<int> refuse_extras();
    std::optional<int> apply_common();

    struct Parser;
    std::unique_ptr<Parser> parser_;
    CommonOptions common_;
    std::optional<std::size_t> memory_bytes_;
    std::optional<double> time_seconds_;
};

}  // namespace frep::cli
