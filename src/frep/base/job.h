// Job: the cancel flag, progress and budgets of one long call. Every long verb takes one; the default
// never cancels and reports to nobody. The library reads no clock: the apps set the flag when time is up.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace frep {

class Job {
  public:
    /// Worker threads to use; 0 means one for each core.
    int threads = 0;
    /// Called now and then from one thread at a time with the done share of the work in 0..1.
    std::function<void(double)> on_progress;

    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
    bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
    void report(double share) const {
        if (on_progress) on_progress(share);
    }

  private:
    std::atomic<bool> cancelled_{false};
};

}  // namespace frep
