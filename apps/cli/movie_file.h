// Frames put together to one moving picture: .gif and .apng by the library, .mp4 by the program ffmpeg.
// Tested by tests/cli/animate.txt.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frame_store.h"

namespace frep::cli {

enum class MovieKind { gif, apng, mp4 };

/// By the extension; nothing for others.
std::optional<MovieKind> movie_kind(const std::string& path);

struct MovieOptions {
    double frames_per_second = 25;
    bool loops = true;
};

/// The frames of `store` in the order of `shown`, as the file `path`. Errors: io, also for ffmpeg when it is
/// missing or fails; invalid_argument for frames of different sizes.
Status write_movie(const FrameStore& store, const std::vector<int>& shown, const std::string& path,
                   MovieKind kind, const MovieOptions& options);

/// The path of the program ffmpeg. Errors: io when there is none.
Result<std::string> find_ffmpeg();

}  // namespace frep::cli
