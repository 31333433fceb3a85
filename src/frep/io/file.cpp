// Implementation of file.h over POSIX calls. Opening never blocks (O_NONBLOCK, for pipes without a partner).
#include "frep/io/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <system_error>

namespace frep {

namespace {

Error io_error(const std::string& what, const std::string& path, int code) {
    return {ErrorKind::io,
            fmt::format("cannot {} '{}': {}", what, path, std::generic_category().message(code))};
}

Error io_error(const std::string& what, const std::string& path, const std::string& cause) {
    return {ErrorKind::io, fmt::format("cannot {} '{}': {}", what, path, cause)};
}

/// A file descriptor that closes itself.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    int get() const { return fd_; }
    bool is_open() const { return fd_ >= 0; }
    /// Returns 0 or the error of close(2).
    int close() {
        const int fd = fd_;
        fd_ = -1;
        return fd >= 0 && ::close(fd) != 0 ? errno : 0;
    }

  private:
    int fd_;
};

/// Writes everything; returns 0 or the error number.
int write_all(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(fd, bytes.data(), bytes.size() < INT_MAX ? bytes.size() : INT_MAX);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(done));
    }
    return 0;
}

/// Appends up to `limit` bytes of `fd` to `out`; returns 0 or the error number.
int read_up_to(int fd, std::size_t limit, std::string& out) {
    constexpr std::size_t step = std::size_t{1} << 20;
    while (out.size() < limit) {
        const std::size_t old_size = out.size();
        out.resize(old_size + (limit - old_size < step ? limit - old_size : step));
        const ssize_t got = ::read(fd, out.data() + old_size, out.size() - old_size);
        out.resize(old_size + (got > 0 ? static_cast<std::size_t>(got) : 0));
        if (got == 0) return 0;
        if (got < 0 && errno != EINTR) return errno;
    }
    return 0;
}

/// Where writing to `path` ends up: links are followed, a dangling one too. Fails on a loop of links.
Result<std::string> follow_links(const std::string& path) {
    std::string at = path;
    for (int hops = 0; hops < 40; ++hops) {
        char target[PATH_MAX];
        const ssize_t size = ::readlink(at.c_str(), target, sizeof target);
        if (size < 0) return at;  // not a link, or nothing there: what is wrong shows later
        const std::string link(target, static_cast<std::size_t>(size));
        const std::size_t slash = at.find_last_of('/');
        const bool absolute = !link.empty() && link[0] == '/';
        at = absolute || slash == std::string::npos ? link : at.substr(0, slash + 1) + link;
    }
    return io_error("write", path, ELOOP);
}

/// Pipes and devices: no rename, the bytes go in directly.
Status write_into_special(const std::string& path, std::string_view bytes) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
    if (!file.is_open() && errno == ENXIO) return io_error("write", path, "nothing reads from it");
    if (!file.is_open()) return io_error("write", path, errno);
    const int flags = ::fcntl(file.get(), F_GETFL);
    if (flags >= 0) ::fcntl(file.get(), F_SETFL, flags & ~O_NONBLOCK);
    if (const int code = write_all(file.get(), bytes)) return io_error("write", path, code);
    if (const int code = file.close()) return io_error("write", path, code);
    return {};
}

/// Creates a file with a new name in the folder of `target`; its name goes to `name`.
int create_beside(const std::string& target, std::string& name) {
    const std::size_t slash = target.find_last_of('/');
    const std::string folder = slash == std::string::npos ? "" : target.substr(0, slash + 1);
    for (int attempt = 0; attempt < 1000; ++attempt) {
        name = fmt::format("{}.frep-{}-{}.tmp", folder, ::getpid(), attempt);
        const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (fd >= 0 || errno != EEXIST) return fd;
    }
    return -1;
}

/// Fills the new file and moves it to `target`; returns 0 or the error number.
int fill_and_rename(Descriptor& file, const std::string& name, const std::string& target,
                    const struct stat* old, std::string_view bytes) {
    if (old && ::fchmod(file.get(), old->st_mode & 07777) != 0) return errno;
    if (const int code = write_all(file.get(), bytes)) return code;
    if (::fsync(file.get()) != 0 && errno != EINVAL) return errno;
    if (const int code = file.close()) return code;
    return ::rename(name.c_str(), target.c_str()) == 0 ? 0 : errno;
}

/// Makes the rename itself durable, where the system can; a failure changes nothing about the file.
void sync_folder_of(const std::string& target) {
    const std::size_t slash = target.find_last_of('/');
    const std::string folder = slash == std::string::npos ? "." : target.substr(0, slash + 1);
    const Descriptor handle(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (handle.is_open()) ::fsync(handle.get());
}

}  // namespace

Result<std::string> read_file(const std::string& path, std::size_t max_bytes) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
    if (!file.is_open()) return io_error("read", path, errno);
    struct stat info = {};
    if (::fstat(file.get(), &info) != 0) return io_error("read", path, errno);
    if (S_ISDIR(info.st_mode)) return io_error("read", path, EISDIR);
    if (!S_ISREG(info.st_mode)) return io_error("read", path, "it is not a regular file");
    const Error too_long{ErrorKind::over_limit,
                         fmt::format("'{}' is longer than the limit of {} bytes", path, max_bytes)};
    if (info.st_size > 0 && static_cast<std::size_t>(info.st_size) > max_bytes) return too_long;
    std::string bytes;
    const std::size_t probe = max_bytes < SIZE_MAX ? max_bytes + 1 : max_bytes;
    if (const int code = read_up_to(file.get(), probe, bytes)) return io_error("read", path, code);
    if (bytes.size() > max_bytes) return too_long;
    return bytes;
}

Status write_file(const std::string& path, std::string_view bytes) {
    if (path.empty()) return io_error("write", path, ENOENT);
    const Result<std::string> followed = follow_links(path);
    if (!followed) return followed.error();
    const std::string& target = *followed;
    struct stat info = {};
    // The path itself is asked, not the followed name: /dev/stdout ends in a name that is no path.
    const bool exists = ::stat(path.c_str(), &info) == 0;
    if (!exists && errno != ENOENT) return io_error("write", path, errno);
    if (exists && S_ISDIR(info.st_mode)) return io_error("write", path, EISDIR);
    if (exists && !S_ISREG(info.st_mode)) return write_into_special(path, bytes);
    if (exists && ::access(path.c_str(), W_OK) != 0) return io_error("write", path, errno);
    std::string name;
    Descriptor file(create_beside(target, name));
    if (!file.is_open()) return io_error("write", path, errno);
    if (const int code = fill_and_rename(file, name, target, exists ? &info : nullptr, bytes)) {
        ::unlink(name.c_str());
        return io_error("write", path, code);
    }
    sync_folder_of(target);
    return {};
}

}  // namespace frep
