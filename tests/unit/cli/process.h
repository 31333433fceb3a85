// Running the command in a scratch folder, with its streams in files.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace frep::test {

inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
}

/// A new folder that is removed with everything in it.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "frep-cli-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("no scratch folder");
        path_ = name;
    }
    ~ScratchFolder() { std::filesystem::remove_all(path_); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

struct Outcome {
    int exit = -1;  ///< 128 + signal when killed by one
    std::string out, err;
};

/// The command at work. Its streams are files of a scratch folder of their own.
class Process {
  public:
    /// `input`: bytes for standard input. `input_fd`: a descriptor in place of them.
    Process(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
            const std::string& input = {}, const std::vector<std::string>& environment = {},
            int input_fd = -1) {
        write_bytes(streams_.path() / "in", input);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        if (input_fd >= 0) {
            posix_spawn_file_actions_adddup2(&actions, input_fd, 0);
        } else {
            posix_spawn_file_actions_addopen(&actions, 0, (streams_.path() / "in").c_str(), O_RDONLY, 0);
        }
        const int create = O_WRONLY | O_CREAT | O_TRUNC;
        posix_spawn_file_actions_addopen(&actions, 1, (streams_.path() / "out").c_str(), create, 0600);
        posix_spawn_file_actions_addopen(&actions, 2, (streams_.path() / "err").c_str(), create, 0600);
        posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        sigset_t set;
        sigemptyset(&set);
        posix_spawnattr_setsigmask(&attributes, &set);
        sigaddset(&set, SIGINT);
        posix_spawnattr_setsigdefault(&attributes, &set);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
        std::vector<char*> argv{const_cast<char*>("frep")}, envp;
        for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
        for (const std::string& e : environment) envp.push_back(const_cast<char*>(e.c_str()));
        argv.push_back(nullptr);
        envp.push_back(nullptr);
        const int code = posix_spawn(&pid_, FREP_PROGRAM, &actions, &attributes, argv.data(), envp.data());
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
        if (code != 0) throw std::runtime_error("cannot run " FREP_PROGRAM);
    }
    ~Process() {
        if (pid_ <= 0) return;
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send(int signal) const { ::kill(pid_, signal); }
    /// What standard output holds now.
    std::string output() const { return read_bytes(streams_.path() / "out"); }

    Outcome wait() {
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = -1;
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), output(),
                read_bytes(streams_.path() / "err")};
    }

  private:
    ScratchFolder streams_;
    pid_t pid_ = -1;
};

}  // namespace frep::test
