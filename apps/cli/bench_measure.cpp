// Implementation of bench_measure.h.
#include "bench_measure.h"

#include <sys/resource.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "terminal.h"

namespace frep::cli {

namespace {

double cpu_seconds() {
    std::timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Spread spread_of(std::vector<double> seconds) {
    std::sort(seconds.begin(), seconds.end());
    const std::size_t half = seconds.size() / 2;
    const double middle = seconds.size() % 2 == 1 ? seconds[half] : 0.5 * (seconds[half - 1] + seconds[half]);
    return {1e3 * middle, 1e3 * seconds.front(), 1e3 * seconds.back()};
}

}  // namespace

Result<Measured> measure(int repeat, const std::function<Status()>& body) {
    if (const Status status = body(); !status) return status.error();
    std::vector<double> cpu, wall;
    for (int i = 0; i < repeat; ++i) {
        const double cpu_start = cpu_seconds(), wall_start = now_seconds();
        const Status status = body();
        cpu.push_back(cpu_seconds() - cpu_start);
        wall.push_back(now_seconds() - wall_start);
        if (!status) return status.error();
    }
    return Measured{spread_of(std::move(cpu)), spread_of(std::move(wall))};
}

std::size_t peak_memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace frep::cli
