// Memory that is about to be written for the first time, in large pages where the system has them: a page is
// the unit in which the system hands it out, and costs about the same whatever its size. On virtual machines
// pages of 4 KB cost more than writing them.
#pragma once

#include <cstddef>

namespace frep {

/// A hint, without effect on what the memory holds: the bytes from `begin` on, none of them written yet, are
/// all going to be. Does nothing where the system knows no such hint, or the part is small.
void expect_to_fill(void* begin, std::size_t bytes);

}  // namespace frep
