#include "frep/base/parallel.h"

#include <algorithm>
#include <thread>
#include <vector>

#ifdef FREP_PARALLEL_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace frep {

int thread_count(const Job& job) {
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    return job.threads > 0 ? job.threads : cores;
}

void parallel_for(const Job& job, std::size_t count, const std::function<void(std::size_t)>& body) {
    const int threads =
        std::min<int>(thread_count(job), static_cast<int>(std::min<std::size_t>(count, 1u << 20)));
    if (threads <= 1) {
        for (std::size_t i = 0; i < count && !job.cancelled(); ++i) body(i);
        return;
    }
#ifdef FREP_PARALLEL_TBB
    // Without it more threads than cores are refused, with a warning on the terminal.
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            if (!job.cancelled()) body(i);
        });
    });
#else
    std::atomic<std::size_t> next{0};
    auto work = [&] {
        for (std::size_t i = next++; i < count && !job.cancelled(); i = next++) body(i);
    };
    std::vector<std::thread> workers;
    for (int t = 1; t < threads; ++t) workers.emplace_back(work);
    work();
    for (std::thread& worker : workers) worker.join();
#endif
}

}  // namespace frep
