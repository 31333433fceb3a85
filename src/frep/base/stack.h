// Runs a function on a stack of a chosen size, for recursions whose depth is limited but larger than what the
// thread of an unknown caller may hold.
#pragma once

#include <cstddef>
#include <functional>

namespace frep {

/// Calls `body` on a thread of its own with `bytes` of stack and waits for it. Where no such thread can be
/// made, `body` runs on the caller's stack.
void run_on_stack(std::size_t bytes, const std::function<void()>& body);

}  // namespace frep
