// Implementation of picture_file.h.
#include "picture_file.h"

#include <fmt/format.h>

#include "budget.h"
#include "terminal.h"
#include "verbs.h"

namespace frep::cli {

int write_picture(const Image& image, const Model& model, const std::string& path) {
    const auto& notes = model.program().annotations;
    PngOptions options;
    options.title = notes.title;
    options.author = notes.author;
    options.license = notes.license;
    options.software = fmt::format("frep {}", version());
    const auto bytes = encode_png(image, options);
    if (!bytes) return fail(bytes.error());
    if (path == "-") return print_result(*bytes);
    const WritingFile guard;
    if (const Status status = write_file(path, *bytes); !status) return fail(status.error());
    return exit_ok;
}

}  // namespace frep::cli
