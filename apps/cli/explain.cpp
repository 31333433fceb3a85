// `frep explain`: the page of a diagnostic's code. Tested by tests/cli/explain.txt.
#include <fmt/format.h>

#include "command_line.h"
#include "json.h"
#include "terminal.h"
#include "verbs.h"

namespace frep::cli {

int run_explain(Arguments arguments) {
    std::string code;
    bool json = false;
    CommandLine line("explain", "explain CODE [options]", "Explains a diagnostic, with an example.",
                     {"frep explain HF012", "frep explain hf3", "frep explain HF012 --json"});
    line.positional("CODE", code, "as messages show it in brackets");
    line.flag("--json", json, "as one JSON object on standard output");
    if (const auto done = line.parse(arguments)) return *done;
    if (code.empty()) return usage_error("a code is missing: give one such as HF012");

    const auto page = lang::explain(code);
    if (!page) return fail(page.error());
    std::string text = *page;
    if (!text.ends_with('\n')) text += '\n';
    if (!json) return print_result(text);
    return print_result(
        json_bytes({{"schema", "frep.explain/1"}, {"code", json_text(code)}, {"text", text}}));
}

}  // namespace frep::cli
