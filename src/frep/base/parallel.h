// parallel_for: the one door to threads. Results must be written to slots given by the index, never appended
// in arrival order, so that the same bytes come out for every number of threads (docs/numerics.md, rule 11).
// Back end: oneTBB, or std::thread for the thread sanitizer (CMake option FREP_PARALLEL).
// Tested by tests/unit/base/parallel_test.cpp.
#pragma once

#include <cstddef>
#include <functional>

#include "frep/base/job.h"

namespace frep {

/// Calls body(i) for every i in [0, count), on at most job.threads threads, in no particular order.
/// Stops early (some bodies not called) once the job is cancelled.
void parallel_for(const Job& job, std::size_t count, const std::function<void(std::size_t)>& body);

/// The number of threads that parallel_for uses for this job.
int thread_count(const Job& job);

}  // namespace frep
