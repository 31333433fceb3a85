// Reading of streams that may be endless: standard input, pipes and point files, in bounded memory.
// Tested by tests/cli.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "frep/frep.h"

namespace frep::cli {

/// True for a named pipe, such as a shell makes for <(command).
bool is_pipe(const std::string& path);

/// All bytes of a stream (`-`: standard input). Errors: io; over_limit beyond `max_bytes`.
Result<std::string> read_stream(const std::string& path, std::size_t max_bytes);

/// Gives the lines of a file or of standard input (`-`), a block of bytes at a time.
class LineReader {
  public:
    explicit LineReader(const std::string& path);
    ~LineReader();
    LineReader(const LineReader&) = delete;
    LineReader& operator=(const LineReader&) = delete;

    /// Whether the file could be opened.
    const Status& status() const { return status_; }
    /// Reads on; false at the end. Whatever has come is taken at once, so that a program at the other end of
    /// a pipe gets its answers. Errors: io, also for a line longer than 64 KiB.
    Result<bool> read_block();
    /// The next whole line of what was read, without its end; false when there is none.
    bool next_line(std::string_view& line);
    /// The number of the line that next_line() gave, from 1.
    std::uint64_t line_number() const { return line_number_; }
    /// The name for messages.
    const std::string& name() const { return name_; }

  private:
    std::string name_;
    int fd_ = -1;
    Status status_;
    std::string buffer_;
    std::size_t position_ = 0;
    bool at_end_ = false;
    std::uint64_t line_number_ = 0;
};

}  // namespace frep::cli
