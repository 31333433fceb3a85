// The finished frames of an animation, as PNG files in a folder beside the result, so that a run that was
// interrupted goes on where it stopped. A key says what the frames show; frames of another key are thrown
// away. Tested by tests/cli/animate.txt.
#pragma once

#include <optional>
#include <string>

#include "frep/frep.h"

namespace frep::cli {

class FrameStore {
  public:
    /// The folder is OUTPUT.frames. Errors: io.
    static Result<FrameStore> open(const std::string& output, const std::string& key);

    const std::string& folder() const { return folder_; }
    std::string path(int frame) const;
    bool has(int frame) const;
    /// Errors: io; invalid_argument for a picture that cannot be written.
    Status put(int frame, const Image& image) const;
    /// Errors: io; invalid_argument for a damaged file.
    Result<Image> get(int frame) const;
    /// Takes the frames and the folder away.
    void remove(int frames) const;

  private:
    explicit FrameStore(std::string folder) : folder_(std::move(folder)) {}
    std::string folder_;
};

}  // namespace frep::cli
