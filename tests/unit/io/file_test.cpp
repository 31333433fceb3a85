// Tests of io/file.h in a scratch folder: bounded reading, all-or-nothing writing.
#include "frep/io/file.h"

#include <doctest/doctest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace frep;
namespace fs = std::filesystem;

namespace {

/// An empty folder that goes away at the end of the test.
struct ScratchFolder {
    ScratchFolder() {
        char pattern[] = "/tmp/frep-io-test-XXXXXX";
        REQUIRE(::mkdtemp(pattern) != nullptr);
        path = pattern;
    }
    ~ScratchFolder() { fs::remove_all(path); }
    std::string operator/(const std::string& name) const { return path + "/" + name; }
    std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(path), fs::directory_iterator()));
    }
    std::string path;
};

std::string content(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

mode_t permissions(const std::string& path) {
    struct stat info = {};
    REQUIRE(::stat(path.c_str(), &info) == 0);
    return info.st_mode & 07777;
}

}  // namespace

TEST_CASE("writing makes the file, with the permissions of the umask") {
    const ScratchFolder folder;
    const mode_t old_mask = ::umask(027);
    REQUIRE(static_cast<bool>(write_file(folder / "new", std::string("a\0b", 3))));
    ::umask(old_mask);
    CHECK(content(folder / "new") == std::string("a\0b", 3));
    CHECK(permissions(folder / "new") == 0640);
    CHECK(folder.entries() == 1);
    REQUIRE(static_cast<bool>(write_file(folder / "new", "")));
    CHECK(content(folder / "new").empty());
}

TEST_CASE("an old file keeps its permissions and its link") {
    const ScratchFolder folder;
    fs::create_directory(folder / "elsewhere");
    std::ofstream(folder / "elsewhere/real") << "old";
    ::chmod((folder / "elsewhere/real").c_str(), 0604);
    fs::create_symlink("elsewhere/real", folder / "link");
    REQUIRE(static_cast<bool>(write_file(folder / "link", "new")));
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(content(folder / "elsewhere/real") == "new");
    CHECK(permissions(folder / "elsewhere/real") == 0604);
    fs::create_symlink("elsewhere/dangling", folder / "second");
    REQUIRE(static_cast<bool>(write_file(folder / "second", "made")));
    CHECK(content(folder / "elsewhere/dangling") == "made");
}

TEST_CASE("a failure leaves the old file and nothing else") {
    const ScratchFolder folder;
    std::ofstream(folder / "kept") << "old";
    // A file size limit makes the write itself fail half way.
    struct rlimit old_limit = {};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &old_limit) == 0);
    const struct rlimit low = {4096, old_limit.rlim_max};
    auto* const old_handler = ::signal(SIGXFSZ, SIG_IGN);
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &low) == 0);
    const Status status = write_file(folder / "kept", std::string(100000, 'x'));
    const Status fresh = write_file(folder / "fresh", std::string(100000, 'x'));
    ::setrlimit(RLIMIT_FSIZE, &old_limit);
    ::signal(SIGXFSZ, old_handler);
    REQUIRE_FALSE(static_cast<bool>(status));
    REQUIRE_FALSE(static_cast<bool>(fresh));
    CHECK(status.error().kind == ErrorKind::io);
    CHECK(status.error().message.find("kept") != std::string::npos);
    CHECK(content(folder / "kept") == "old");
    CHECK(folder.entries() == 1);
}

TEST_CASE("places that cannot be written") {
    const ScratchFolder folder;
    CHECK_FALSE(static_cast<bool>(write_file("", "x")));
    CHECK_FALSE(static_cast<bool>(write_file(folder.path, "x")));
    CHECK_FALSE(static_cast<bool>(write_file(folder / "missing/file", "x")));
    fs::create_symlink("loop", folder / "loop");
    CHECK_FALSE(static_cast<bool>(write_file(folder / "loop", "x")));
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    CHECK_FALSE(static_cast<bool>(write_file(folder / "pipe", "x")));  // nobody reads: an error, no waiting
    CHECK_FALSE(static_cast<bool>(write_file("/dev/full", "x")));
    CHECK(folder.entries() == 2);
}

TEST_CASE("a device is written to, not replaced") {
    REQUIRE(static_cast<bool>(write_file("/dev/null", "gone")));
    CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("reading is bounded and never waits") {
    const ScratchFolder folder;
    std::ofstream(folder / "five") << "12345";
    CHECK(*read_file(folder / "five", 5) == "12345");
    const Result<std::string> too_long = read_file(folder / "five", 4);
    REQUIRE_FALSE(static_cast<bool>(too_long));
    CHECK(too_long.error().kind == ErrorKind::over_limit);
    std::ofstream(folder / "empty") << "";
    CHECK(*read_file(folder / "empty", 0) == "");
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    for (const std::string& bad :
         {folder / "missing", folder.path, folder / "pipe", std::string("/dev/zero")}) {
        const Result<std::string> bytes = read_file(bad, 1000);
        REQUIRE_FALSE(static_cast<bool>(bytes));
        CHECK(bytes.error().kind == ErrorKind::io);
        CHECK(bytes.error().message.find(bad) != std::string::npos);
    }
    const Result<std::string> kernel_text = read_file("/proc/self/status", 1 << 20);  // has size 0 in stat
    REQUIRE(static_cast<bool>(kernel_text));
    CHECK(kernel_text->find("Pid") != std::string::npos);
}
