// Implementation of command_line.h over CLI11.
#include "command_line.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "budget.h"
#include "frep/frep.h"
#include "terminal.h"
#include "values.h"

namespace frep::cli {

namespace {

/// Help that begins with the examples.
class ExamplesFirst : public CLI::Formatter {
  public:
    ExamplesFirst(std::string examples, std::string usage)
        : examples_(std::move(examples)), usage_(std::move(usage)) {
        column_width(34);
        label("REQUIRED", "");
    }
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
        return examples_ + "\n" + CLI::Formatter::make_help(app, std::move(name), mode);
    }
    std::string make_usage(const CLI::App*, std::string) const override { return "\n" + usage_ + "\n"; }

  private:
    std::string examples_, usage_;
};

/// CLI11's message, in plainer words where it speaks of counts.
std::string message_of(const CLI::ParseError& error) {
    const std::string text = error.what();
    const std::size_t colon = text.find(": ");
    if (colon == std::string::npos) return text;
    if (text.find("At Most 1", colon) != std::string::npos)
        return text.substr(0, colon) + ": given more than once";
    if (text.find("required", colon) != std::string::npos)
        return text.substr(0, colon) + ": a value is missing";
    return text;
}

std::optional<Isa> isa_named(std::string_view name) {
    for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512})
        if (name == name_of(isa)) return isa;
    return std::nullopt;
}

}  // namespace

struct CommandLine::Parser {
    explicit Parser(const std::string& doc) : app(doc) {}
    CLI::App app;
    std::string verb;
    std::vector<std::string> names;  ///< of all options, with their dashes
};

CommandLine::CommandLine(std::string_view verb, std::string_view synopsis, std::string_view doc,
                         std::vector<std::string> examples)
    : parser_(std::make_unique<Parser>(std::string(doc))) {
    parser_->verb = verb;
    std::string lines = "Examples:\n";
    for (const std::string& example : examples) lines += "  " + example + "\n";
    CLI::App& app = parser_->app;
    app.formatter(std::make_shared<ExamplesFirst>(std::move(lines), fmt::format("Usage: frep {}", synopsis)));
    app.set_help_flag("-h,--help", "this text");
    app.allow_extras();  // unknown options are told by refuse_extras(), with a suggestion
    parser_->names.emplace_back("--help");
    flag("--quiet", common_.quiet, "no messages but errors");
    parser_->app.add_option("--color", common_.color, "colors in messages: auto, always or never")
        ->type_name("WHEN");
    parser_->names.emplace_back("--color");
    text("--time-limit", common_.time_limit, "TIME", "stop with exit code 5 after this long: 10s, 2m, 500ms");
    text("--memory-limit", common_.memory_limit, "SIZE", "use at most this much memory: 512M, 2G");
    text("--isa", common_.isa, "SET", "instructions no wider than sse2, avx2 or avx512; the same results");
}

CommandLine::~CommandLine() = default;

void CommandLine::positional(const std::string& name, std::string& target, const std::string& doc) {
    parser_->app.add_option(name, target, doc)->type_name("");
}

void CommandLine::text(const std::string& names, std::optional<std::string>& target,
                       const std::string& metavar, const std::string& doc) {
    parser_->app
        .add_option_function<std::string>(
            names, [&target](const std::string& value) { target = value; }, doc)
        ->type_name(metavar);
    for (const std::string& name : CLI::detail::split(names, ',')) parser_->names.push_back(name);
}

void CommandLine::texts(const std::string& names, std::vector<std::string>& target,
                        const std::string& metavar, const std::string& doc) {
    parser_->app.add_option(names, target, doc)
        ->type_name(metavar)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    for (const std::string& name : CLI::detail::split(names, ',')) parser_->names.push_back(name);
}

void CommandLine::flag(const std::string& names, bool& target, const std::string& doc) {
    parser_->app.add_flag(names, target, doc);
    for (const std::string& name : CLI::detail::split(names, ',')) parser_->names.push_back(name);
}

std::optional<int> CommandLine::refuse_extras() {
    const std::vector<std::string> extras = parser_->app.remaining();
    if (extras.empty()) return std::nullopt;
    const auto is_option = [](const std::string& s) { return s.size() > 1 && s[0] == '-'; };
    const auto option = std::find_if(extras.begin(), extras.end(), is_option);
    if (option == extras.end()) {
        print_error(fmt::format("one argument too many: `{}`", extras.front()));
        return exit_usage;
    }
    const std::string name = option->substr(0, option->find('='));
    const std::vector<std::string_view> known(parser_->names.begin(), parser_->names.end());
    print_error(fmt::format("`frep {}` has no option `{}`", parser_->verb, name));
    const std::string_view near = name.starts_with("--") ? nearest_name(name, known) : std::string_view();
    print_help_line(near.empty() ? fmt::format("`frep {} --help` lists the options", parser_->verb)
                                 : fmt::format("did you mean `{}`?", near));
    return exit_usage;
}

std::optional<int> CommandLine::apply_common() {
    if (common_.color != "auto" && common_.color != "always" && common_.color != "never")
        return usage_error(fmt::format("--color: `{}` is not auto, always or never", common_.color));
    Budget budget;
    if (common_.time_limit) {
        const auto seconds = parse_duration(*common_.time_limit);
        if (!seconds) return usage_error("--time-limit: " + seconds.error().message);
        budget.seconds = *seconds;
        time_seconds_ = *seconds;
    }
    if (common_.memory_limit) {
        const auto bytes = parse_size(*common_.memory_limit);
        if (!bytes) return usage_error("--memory-limit: " + bytes.error().message);
        budget.memory = *bytes;
        memory_bytes_ = *bytes;
    }
    if (common_.isa) {
        const auto limit = isa_named(*common_.isa);
        if (!limit) return usage_error(fmt::format("--isa: `{}` is not sse2, avx2 or avx512", *common_.isa));
        set_isa_limit(*limit);
    }
    set_budget(budget);
    return std::nullopt;
}

std::optional<int> CommandLine::parse(Arguments arguments) {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    try {
        parser_->app.parse(reversed);
    } catch (const CLI::CallForHelp&) {
        return print_result(parser_->app.help());
    } catch (const CLI::ParseError& error) {
        print_error(message_of(error));
        print_help_line(fmt::format("`frep {} --help` shows how it is used", parser_->verb));
        return exit_usage;
    }
    voice().quiet = common_.quiet;
    set_color(common_.color);
    if (const auto code = refuse_extras()) return code;
    return apply_common();
}

}  // namespace frep::cli
