// Implementation of movie_file.h.
#include "movie_file.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include "budget.h"
#include "values.h"

extern char** environ;

namespace frep::cli {

namespace {

namespace fs = std::filesystem;
Error io_error(std::string message) { return {ErrorKind::io, std::move(message)}; }

/// Every nth frame, a dozen at most, for the palette.
Result<GifPalette> palette_of(const FrameStore& store, const std::vector<int>& shown) {
    std::vector<Image> examples;
    const std::size_t step = (shown.size() + 11) / 12;
    for (std::size_t i = 0; i < shown.size(); i += step) {
        auto image = store.get(shown[i]);
        if (!image) return image.error();
        examples.push_back(std::move(*image));
    }
    return gif_palette(examples);
}

/// The frames, one after the other, into a writer of the library.
template <class Writer>
Status add_frames(const FrameStore& store, const std::vector<int>& shown, Writer& writer) {
    for (const int frame : shown) {
        const auto image = store.get(frame);
        if (!image) return image.error();
        if (const Status status = writer.add(*image); !status) return status;
    }
    return {};
}

Result<std::string> as_gif(const FrameStore& store, const std::vector<int>& shown,
                           const MovieOptions& options) {
    auto palette = palette_of(store, shown);
    if (!palette) return palette.error();
    const auto first = store.get(shown.front());
    if (!first) return first.error();
    GifOptions gif;
    gif.hundredths = std::max(2, static_cast<int>(std::lround(100 / options.frames_per_second)));
    gif.loops = options.loops;
    auto writer = GifWriter::make(first->width, first->height, std::move(*palette), gif);
    if (!writer) return writer.error();
    if (const Status status = add_frames(store, shown, *writer); !status) return status.error();
    return writer->finish();
}

Result<std::string> as_apng(const FrameStore& store, const std::vector<int>& shown,
                            const MovieOptions& options) {
    ApngOptions apng;
    apng.frames = static_cast<int>(shown.size());
    apng.delay_numerator = 100;
    apng.delay_denominator = static_cast<int>(std::lround(100 * options.frames_per_second));
    apng.loops = options.loops;
    Image first;
    for (const int frame : shown) {
        auto image = store.get(frame);
        if (!image) return image.error();
        apng.opaque = apng.opaque && is_opaque(*image);
        if (frame == shown.front()) first = std::move(*image);
    }
    auto writer = ApngWriter::make(first.width, first.height, apng);
    if (!writer) return writer.error();
    if (const Status status = add_frames(store, shown, *writer); !status) return status.error();
    return writer->finish();
}

std::string find_program(const std::string& name) {
    const char* const paths = std::getenv("PATH");
    std::string rest = paths ? paths : "";
    for (std::size_t at = 0; at <= rest.size();) {
        const std::size_t end = std::min(rest.find(':', at), rest.size());
        const std::string path = rest.substr(at, end - at) + "/" + name;
        if (end > at && ::access(path.c_str(), X_OK) == 0) return path;
        at = end + 1;
    }
    return {};
}

/// Runs a program, without its standard input, and waits for it. Its own messages go to standard error.
Status run_program(const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    pid_t child = 0;
    if (::posix_spawn(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0)
        return io_error(fmt::format("cannot start {}", arguments[0]));
    int state = 0;
    while (::waitpid(child, &state, 0) == -1 && errno == EINTR) {
    }
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return {};
    return io_error(fmt::format("{} failed", arguments[0]));
}

/// ffmpeg reads numbered files; where frames are shown in another order, links are made.
Status write_mp4(const FrameStore& store, const std::vector<int>& shown, const std::string& path,
                 const MovieOptions& options) {
    const auto program = find_ffmpeg();
    if (!program) return program.error();
    const fs::path order = fs::path(store.folder()) / "order";
    std::error_code error;
    fs::remove_all(order, error);
    fs::create_directory(order, error);
    if (error) return io_error(fmt::format("cannot make the folder '{}'", order.string()));
    for (std::size_t i = 0; i < shown.size(); ++i)
        fs::create_symlink(fs::absolute(store.path(shown[i]), error), order / fmt::format("{:06}.png", i),
                           error);
    const std::string made = store.folder() + "/movie.mp4";
    const Status status = run_program({*program,
                                       "-nostdin",
                                       "-loglevel",
                                       "error",
                                       "-y",
                                       "-framerate",
                                       number_text(options.frames_per_second),
                                       "-i",
                                       (order / "%06d.png").string(),
                                       "-vf",
                                       "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
                                       "-c:v",
                                       "libx264",
                                       "-crf",
                                       "18",
                                       "-pix_fmt",
                                       "yuv420p",
                                       "-movflags",
                                       "+faststart",
                                       made});
    fs::remove_all(order, error);
    if (!status) {
        fs::remove(made, error);
        return status;
    }
    const WritingFile guard;
    fs::rename(made, path, error);
    if (error) return io_error(fmt::format("cannot write '{}': {}", path, error.message()));
    return {};
}

}  // namespace

std::optional<MovieKind> movie_kind(const std::string& path) {
    const std::string extension = lower_case(fs::path(path).extension().string());
    if (extension == ".gif") return MovieKind::gif;
    if (extension == ".apng" || extension == ".png") return MovieKind::apng;
    if (extension == ".mp4") return MovieKind::mp4;
    return std::nullopt;
}

Result<std::string> find_ffmpeg() {
    std::string program = find_program("ffmpeg");
    if (program.empty())
        return io_error(
            "an .mp4 needs the program ffmpeg, which is not installed (apt-get install ffmpeg); "
            ".gif and .apng need nothing");
    return program;
}

Status write_movie(const FrameStore& store, const std::vector<int>& shown, const std::string& path,
                   MovieKind kind, const MovieOptions& options) {
    if (kind == MovieKind::mp4) return write_mp4(store, shown, path, options);
    const auto bytes =
        kind == MovieKind::gif ? as_gif(store, shown, options) : as_apng(store, shown, options);
    if (!bytes) return bytes.error();
    const WritingFile guard;
    return write_file(path, *bytes);
}

}  // namespace frep::cli
