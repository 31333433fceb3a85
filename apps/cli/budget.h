// Budgets of the process and Ctrl-C: time, memory, interruption. A watcher thread waits for signals and for
// the deadline and ends the process at once, with a message and the right exit code; files are only ever put
// in place whole (WritingFile), so nothing half-written stays. Tested by tests/cli and
// tests/unit/cli/interrupt_test.cpp.
#pragma once

#include <cstddef>

namespace frep::cli {

struct Budget {
    double seconds = 0;      ///< 0: no limit
    std::size_t memory = 0;  ///< bytes of address space; 0: no limit
};

/// Routes signals to the watcher and makes failed allocations an exit with code 5. Call it before any other
/// thread exists.
void start_watching();

/// Sets the limits of this run; time counts from start_watching().
void set_budget(const Budget& budget);

/// While one lives, the process is not ended by the watcher (a second Ctrl-C ends it all the same); what came
/// in meanwhile takes effect when the last one goes.
class WritingFile {
  public:
    WritingFile();
    ~WritingFile();
    WritingFile(const WritingFile&) = delete;
    WritingFile& operator=(const WritingFile&) = delete;
};

/// Told by the progress bar, so that a message of the watcher does not run into it.
void bar_on_screen(bool yes);

}  // namespace frep::cli
