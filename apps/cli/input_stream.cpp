// Implementation of input_stream.h over read(2).
#include "input_stream.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include <fmt/format.h>

namespace frep::cli {

namespace {

constexpr std::size_t block_size = std::size_t{1} << 18;
constexpr std::size_t line_limit = std::size_t{1} << 16;

Error read_error(const std::string& name, int code) {
    return {ErrorKind::io, fmt::format("cannot read '{}': {}", name, std::generic_category().message(code))};
}

/// Appends what is there, at most a block: the number of bytes, 0 at the end, or -1 with errno.
ssize_t read_more(int fd, std::string& buffer) {
    const std::size_t old_size = buffer.size();
    buffer.resize(old_size + block_size);
    ssize_t got = -1;
    do {
        got = ::read(fd, buffer.data() + old_size, block_size);
    } while (got < 0 && errno == EINTR);
    buffer.resize(old_size + (got > 0 ? static_cast<std::size_t>(got) : 0));
    return got;
}

std::string shown_name(const std::string& path) { return path == "-" ? "<stdin>" : path; }

}  // namespace

bool is_pipe(const std::string& path) {
    struct stat info = {};
    return ::stat(path.c_str(), &info) == 0 && S_ISFIFO(info.st_mode);
}

Result<std::string> read_stream(const std::string& path, std::size_t max_bytes) {
    const int fd = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return read_error(path, errno);
    std::string bytes;
    ssize_t got = 1;
    while (got > 0 && bytes.size() <= max_bytes) got = read_more(fd, bytes);
    const int code = got < 0 ? errno : 0;
    if (path != "-") ::close(fd);
    if (code != 0) return read_error(shown_name(path), code);
    if (bytes.size() > max_bytes)
        return Error{ErrorKind::over_limit,
                     fmt::format("'{}' is longer than the limit of {} bytes", shown_name(path), max_bytes)};
    return bytes;
}

LineReader::LineReader(const std::string& path) : name_(shown_name(path)) {
    fd_ = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
    if (fd_ < 0) status_ = read_error(name_, errno);
}

LineReader::~LineReader() {
    if (fd_ > STDIN_FILENO) ::close(fd_);
}

Result<bool> LineReader::read_block() {
    buffer_.erase(0, position_);
    position_ = 0;
    if (at_end_) return false;
    const bool first = line_number_ == 0 && buffer_.empty();
    const ssize_t got = read_more(fd_, buffer_);
    if (got < 0) return read_error(name_, errno);
    if (got == 0) at_end_ = true;
    if (first && buffer_.starts_with("\xEF\xBB\xBF")) position_ = 3;
    if (buffer_.size() > line_limit && buffer_.find('\n') == std::string::npos)
        return Error{ErrorKind::io, fmt::format("{}:{}:1: a line of more than {} bytes", name_,
                                                line_number_ + 1, line_limit)};
    return !at_end_ || !buffer_.empty();
}

bool LineReader::next_line(std::string_view& line) {
    const std::string_view rest = std::string_view(buffer_).substr(position_);
    std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) {
        if (!at_end_ || rest.empty()) return false;
        end = rest.size();
    }
    line = rest.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    position_ += end < rest.size() ? end + 1 : end;
    ++line_number_;
    return true;
}

}  // namespace frep::cli
