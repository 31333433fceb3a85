// Implementation of mesh_output.h.
#include "mesh_output.h"

#include "budget.h"
#include "terminal.h"

namespace frep::cli {

int write_output(const MeshOptions& options, const EncodedFiles& files) {
    if (!options.output) return exit_ok;
    if (*options.output == "-") return print_result(files.bytes);
    const WritingFile guard;
    if (const Status status = write_files(*options.output, files); !status) return fail(status.error());
    return exit_ok;
}

int deliver_report(const MeshOptions& options, const std::string& bytes,
                   const std::vector<std::string>& broken) {
    if (options.report && *options.report != "-") {
        const WritingFile guard;
        if (const Status status = write_file(*options.report, bytes); !status) return fail(status.error());
    }
    if (options.json || options.report.value_or("") == "-")
        if (const int code = print_result(bytes)) return code;
    for (const std::string& sentence : broken) print_error(sentence);
    return broken.empty() ? exit_ok : exit_check_failed;
}

std::string destination(const MeshOptions& options) {
    if (!options.output) return "";
    return *options.output == "-" ? " to standard output" : " to " + *options.output;
}

}  // namespace frep::cli
