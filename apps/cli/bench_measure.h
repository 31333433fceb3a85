// Measuring for `frep bench`: processor time and time of day of repeated runs, and the peak of memory.
#pragma once

#include <cstddef>
#include <functional>

#include "frep/frep.h"

namespace frep::cli {

/// Milliseconds of several runs.
struct Spread {
    double median = 0, min = 0, max = 0;
};

struct Measured {
    Spread cpu;   ///< user and system time of the whole process, all threads together
    Spread wall;  ///< time of day
};

/// Runs `body` once to warm up, then `repeat` times. The error of the first run that fails.
Result<Measured> measure(int repeat, const std::function<Status()>& body);

/// The largest resident size of this process so far, in bytes.
std::size_t peak_memory();

}  // namespace frep::cli
