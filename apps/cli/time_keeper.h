// Cancels a job shortly before the time limit of the command, for verbs that can tell what they have reached
// by then. Tested by tests/cli/measure.txt.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "budget.h"
#include "frep/frep.h"

namespace frep::cli {

/// While it lives, cancels `job` once 0.8 of `limit` seconds have passed since it was made; from then on what
/// was reached may still be printed, until it goes.
class TimeKeeper {
  public:
    TimeKeeper(Job& job, std::optional<double> limit) {
        if (!limit) return;
        watch_ = std::thread([this, &job, seconds = 0.8 * *limit] {
            std::unique_lock lock(mutex_);
            if (done_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return is_done_; }))
                return;
            telling_.emplace();
            job.cancel();
        });
    }
    ~TimeKeeper() {
        {
            const std::lock_guard lock(mutex_);
            is_done_ = true;
        }
        done_.notify_one();
        if (watch_.joinable()) watch_.join();
    }
    TimeKeeper(const TimeKeeper&) = delete;
    TimeKeeper& operator=(const TimeKeeper&) = delete;

  private:
    std::mutex mutex_;
    std::condition_variable done_;
    bool is_done_ = false;
    std::optional<WritingFile> telling_;
    std::thread watch_;
};

}  // namespace frep::cli
