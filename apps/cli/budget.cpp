// Implementation of budget.h: one detached thread in sigtimedwait(2).
#include "budget.h"

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <mutex>
#include <new>
#include <thread>

#include "terminal.h"
#include "verbs.h"

namespace frep::cli {

namespace {

// Trivially destructible, since the watcher lives until the process ends.
std::atomic<double> deadline{0};
std::atomic<double> time_limit{0};
std::atomic<int> writers{0};
std::atomic<int> pending{0};  ///< exit code to leave with once no file is being written
std::atomic<bool> bar{false};
std::mutex gate;  ///< held while the process is ended: no file is begun then
double start_time = 0;
sigset_t watched;

constexpr int exit_terminated = 128 + SIGTERM, exit_hung_up = 128 + SIGHUP;

/// Ends the process with a message made without allocations.
[[noreturn]] void leave(int code) {
    char text[160] = "";
    if (code == exit_over_limit) {
        std::snprintf(text, sizeof text, "error: stopped at the time limit of %g s\n", time_limit.load());
    } else if (code == exit_interrupted) {
        std::snprintf(text, sizeof text, "error: interrupted\n");
    }
    const char* clear = "\r\x1b[K";
    if (bar && ::write(STDERR_FILENO, clear, std::strlen(clear)) < 0) ::_exit(code);
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) ::_exit(code);
    ::_exit(code);
}

void leave_when_safe(int code) {
    const std::lock_guard lock(gate);
    pending = code;
    if (writers == 0) leave(code);
}

int exit_code_of(int signal) {
    return signal == SIGINT ? int{exit_interrupted} : signal == SIGHUP ? exit_hung_up : exit_terminated;
}

[[noreturn]] void watch() {
    int interruptions = 0;
    while (true) {
        const double end = deadline;
        double wait = 0.2;  // a deadline set later is seen within this time
        if (end > 0) wait = end - now_seconds();
        if (end > 0 && wait <= 0) {
            leave_when_safe(exit_over_limit);
            wait = 0.2;
        }
        if (wait > 0.2) wait = 0.2;
        timespec time{};
        time.tv_nsec = static_cast<long>(wait * 1e9);
        const int signal = ::sigtimedwait(&watched, nullptr, &time);
        if (signal <= 0) continue;
        if (++interruptions > 1) leave(exit_code_of(signal));
        leave_when_safe(exit_code_of(signal));
    }
}

/// operator new calls it when there is no memory. While a file is written, the failure goes up as an
/// exception, so that the temporary file is removed.
void out_of_memory() {
    if (writers > 0) throw std::bad_alloc();
    constexpr char text[] = "error: out of memory (over the limit of --memory-limit or of the system)\n";
    if (::write(STDERR_FILENO, text, sizeof text - 1) < 0) ::_exit(exit_over_limit);
    ::_exit(exit_over_limit);
}

bool is_ignored(int signal) {
    struct sigaction action = {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void start_watching() {
    start_time = now_seconds();
    ::sigemptyset(&watched);
    ::sigaddset(&watched, SIGINT);
    ::sigaddset(&watched, SIGTERM);
    if (!is_ignored(SIGHUP)) ::sigaddset(&watched, SIGHUP);  // nohup
    ::pthread_sigmask(SIG_BLOCK, &watched, nullptr);
    std::set_new_handler(out_of_memory);
    try {
        std::thread(watch).detach();
    } catch (const std::exception&) {  // no thread to be had: the default action of the signals will do
        ::pthread_sigmask(SIG_UNBLOCK, &watched, nullptr);
    }
}

void set_budget(const Budget& budget) {
    if (budget.memory > 0) {
        rlimit limit{};
        if (::getrlimit(RLIMIT_AS, &limit) == 0) {
            const rlim_t wanted = budget.memory;
            limit.rlim_cur =
                limit.rlim_max == RLIM_INFINITY || wanted < limit.rlim_max ? wanted : limit.rlim_max;
            if (::setrlimit(RLIMIT_AS, &limit) != 0)
                print_warning("the memory limit cannot be set on this system");
        }
    }
    if (budget.seconds > 0) {
        time_limit = budget.seconds;
        deadline = start_time + budget.seconds;
    }
}

WritingFile::WritingFile() {
    const std::lock_guard lock(gate);
    ++writers;
}

WritingFile::~WritingFile() {
    if (--writers == 0 && pending != 0) leave(pending);
}

void bar_on_screen(bool yes) { bar = yes; }

}  // namespace frep::cli
