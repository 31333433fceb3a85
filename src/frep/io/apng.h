// Moving pictures as animated PNG files (PNG Third Edition, W3C 2025: acTL, fcTL, fdAT), in memory; programs
// that do not know them show the first frame. Full color, no loss. The same frames and options give the same
// bytes. Tested by tests/unit/io/apng_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frep/base/result.h"
#include "frep/geom/image.h"

namespace frep {

struct ApngOptions {
    int frames = 1;           ///< how many will come; the file's beginning says it
    int delay_numerator = 1;  ///< a frame is shown for numerator/denominator seconds, 0..65535 each
    int delay_denominator = 25;
    bool loops = true;   ///< for ever; else once
    bool opaque = true;  ///< no alpha channel: pixels are taken as they are
};

/// Takes frames of one size, one after the other.
class ApngWriter {
  public:
    /// Errors: invalid_argument for sides out of 1..65535, or options out of range.
    static Result<ApngWriter> make(int width, int height, const ApngOptions& options);

    /// Errors: invalid_argument for a picture of another size, or more frames than stated.
    Status add(const Image& frame);
    /// The bytes of the whole file; the writer is spent. Errors: invalid_argument when frames are missing.
    Result<std::string> finish();

  private:
    ApngWriter(int width, int height, const ApngOptions& options);
    /// One deflated picture: rows with the filter that makes the smallest sum of magnitudes.
    Result<std::string> compressed(const Image& frame) const;

    int width_, height_, added_ = 0;
    std::uint32_t sequence_ = 0;
    ApngOptions options_;
    std::string bytes_;
};

}  // namespace frep
