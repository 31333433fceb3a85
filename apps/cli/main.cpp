// The command `frep`: finds the verb and hands it the rest of the line. See docs/cli.md.
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "budget.h"
#include "terminal.h"
#include "verbs.h"

namespace frep::cli {

namespace {

struct Verb {
    std::string_view name;
    std::string_view doc;
    int (*run)(Arguments);
};

constexpr std::array verbs = {
    Verb{"check", "find the mistakes of a model", run_check},
    Verb{"info", "what a model consists of; the library; the engines", run_info},
    Verb{"explain", "a diagnostic explained, with an example", run_explain},
    Verb{"eval", "the function's values, gradients or intervals at points", run_eval},
    Verb{"mesh", "the surface of a model as a triangle mesh", run_mesh},
    Verb{"convert", "a mesh file in another format, or a model in an exchange form", run_convert},
    Verb{"field", "the function on a plane as a figure", run_field},
    Verb{"render", "a picture of a solid", run_render},
    Verb{"morph", "a model in which one shape turns into another", run_morph},
    Verb{"animate", "a moving picture of a model that changes, or turns", run_animate},
    Verb{"measure", "volume, centroid, inertia and weight, with guaranteed intervals", run_measure},
    Verb{"collide", "whether two models have points in common", run_collide},
    Verb{"bench", "how long loading, evaluating, pictures and meshes take", run_bench},
};

std::string version_line() {
    return fmt::format("frep {} (numeric profile {})\n", version(), numeric_profile());
}

std::string overview() {
    std::string text =
        "Examples:\n"
        "  frep mesh pot.hf -o pot.stl           a model becomes a mesh\n"
        "  frep check pot.hf                     what is wrong with it, and where\n"
        "  echo 0 0 1 | frep eval pot.hf --points -\n"
        "\n"
        "Shape modeling with real functions: a shape is where F(x) >= 0.\n"
        "\n"
        "Usage: frep VERB INPUT [options]\n"
        "\n"
        "Verbs:\n";
    for (const Verb& verb : verbs) text += fmt::format("  {:<9} {}\n", verb.name, verb.doc);
    text +=
        "\n"
        "  frep VERB --help   options of a verb\n"
        "  frep --version     version and numeric profile\n";
    return text;
}

int unknown_verb(const std::string& name) {
    std::vector<std::string_view> names;
    for (const Verb& verb : verbs) names.push_back(verb.name);
    print_error(fmt::format("no verb `{}`", name));
    if (const std::string_view near = nearest_name(name, names); !near.empty()) {
        print_help_line(fmt::format("did you mean `frep {}`?", near));
    } else {
        print_help_line("`frep --help` lists the verbs");
    }
    return exit_usage;
}

int run(const std::vector<std::string>& arguments) {
    set_color("auto");
    if (arguments.empty()) {
        print_error("a verb is missing");
        print_help_line("`frep --help` lists the verbs");
        return exit_usage;
    }
    const std::string& first = arguments[0];
    if (first == "--version" || first == "-V") return print_result(version_line());
    if (first == "--help" || first == "-h") return print_result(overview());
    if (first == "help") {
        if (arguments.size() == 1) return print_result(overview());
        return run({arguments[1], "--help"});
    }
    for (const Verb& verb : verbs)
        if (verb.name == first) return verb.run(Arguments(arguments).subspan(1));
    if (first.starts_with("-")) return usage_error(fmt::format("no option `{}` before a verb", first));
    return unknown_verb(first);
}

/// Closed standard streams are filled with files that fail, so that no output file ever takes their number.
void occupy_standard_streams() {
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(fd, F_GETFD) == -1) ::open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
}

}  // namespace
}  // namespace frep::cli

int main(int argc, char** argv) {
    using namespace frep::cli;
    occupy_standard_streams();
    start_watching();
    try {
        std::vector<std::string> arguments;
        for (int i = 1; i < argc; ++i) arguments.emplace_back(argv[i]);
        return run(arguments);
    } catch (const std::bad_alloc&) {
        print_error("out of memory (over the limit of --memory-limit or of the system)");
        return exit_over_limit;
    } catch (const std::length_error&) {
        print_error("out of memory: a table would be too large");
        return exit_over_limit;
    } catch (const std::system_error& error) {
        print_error(fmt::format("the system refuses: {}", error.what()));
        return exit_over_limit;
    }
}
