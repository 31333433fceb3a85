// What a text file cannot say: interruption, budgets, the same bytes for every number of threads, streams
// without end, large inputs.
#include <algorithm>
#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "process.h"

namespace {

using namespace frep::test;
namespace fs = std::filesystem;

const std::string sphere = "my_model(x[3], a[1]) { my_model = 25 - x[1]^2 - x[2]^2 - x[3]^2; }\n";
/// Every cell of any grid must be evaluated, and takes a while.
const std::string slow =
    "my_model(x[3], a[1]) { i = 0; f = 0; while i < 200 + x[1] loop f = f + sin(x[2]*i); i = i + 1; endloop; "
    "my_model = f + x[3]; }\n";

void pause_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

Outcome run(const std::vector<std::string>& arguments, const fs::path& folder,
            const std::string& input = {}) {
    return Process(arguments, folder, input).wait();
}

}  // namespace

TEST_CASE("Ctrl-C leaves the old file and nothing else") {
    const ScratchFolder folder;
    write_bytes(folder.path() / "slow.hf", slow);
    write_bytes(folder.path() / "out.stl", "old");
    Process process({"mesh", "slow.hf", "-o", "out.stl", "--grid", "900", "--bounds", "5"}, folder.path());
    pause_ms(400);
    process.send(SIGINT);
    const Outcome outcome = process.wait();
    CHECK(outcome.exit == 130);
    CHECK(read_bytes(folder.path() / "out.stl") == "old");
    CHECK(entries(folder.path()) == 2);
}

TEST_CASE("a stream is answered as it comes, and Ctrl-C ends the wait") {
    const ScratchFolder folder;
    write_bytes(folder.path() / "m.hf", sphere);
    int pipe[2];
    REQUIRE(::pipe2(pipe, O_CLOEXEC) == 0);
    Process process({"eval", "m.hf", "--points", "-"}, folder.path(), {}, {}, pipe[0]);
    REQUIRE(::write(pipe[1], "0 0 0\n0 0", 9) == 9);
    for (int i = 0; i < 300 && process.output().empty(); ++i) pause_ms(20);
    CHECK(process.output() == "25\n");
    REQUIRE(::write(pipe[1], " 1\n", 3) == 3);
    for (int i = 0; i < 300 && process.output().size() < 6; ++i) pause_ms(20);
    CHECK(process.output() == "25\n24\n");
    process.send(SIGINT);
    CHECK(process.wait().exit == 130);
    ::close(pipe[0]);
    ::close(pipe[1]);
}

TEST_CASE("the time limit") {
    const ScratchFolder folder;
    write_bytes(folder.path() / "slow.hf", slow);
    const Outcome outcome =
        run({"mesh", "slow.hf", "-o", "out.stl", "--grid", "900", "--bounds", "5", "--time-limit", "300ms"},
            folder.path());
    CHECK(outcome.exit == 5);
    CHECK(outcome.err.ends_with("error: stopped at the time limit of 0.3 s\n"));
    CHECK(entries(folder.path()) == 1);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FREP_SANITIZED  // sanitizers reserve terabytes of address space
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FREP_SANITIZED
#endif
#endif

#ifndef FREP_SANITIZED
TEST_CASE("the memory limit") {
    const ScratchFolder folder;
    write_bytes(folder.path() / "m.hf", sphere);
    const Outcome outcome =
        run({"mesh", "m.hf", "-o", "out.stl", "--grid", "3000", "--bounds", "6", "--memory-limit", "400M"},
            folder.path());
    CHECK(outcome.exit == 5);
    CHECK(outcome.err.find("memory") != std::string::npos);
    CHECK(entries(folder.path()) == 1);
}
#endif

TEST_CASE("the same bytes for every number of threads") {
    const ScratchFolder folder;
    write_bytes(folder.path() / "m.hf", sphere);
    std::string points;
    for (int i = 0; i < 40000; ++i)
        points += std::to_string(i % 200) + " " + std::to_string(i * 0.001) + "\n";
    const auto mesh = [&](const char* threads) {
        return run({"mesh", "m.hf", "-o", "-", "--grid", "40", "-j", threads}, folder.path());
    };
    const auto eval = [&](const char* threads) {
        return run({"eval", "m.hf", "--points", "-", "--gradient", "-j", threads}, folder.path(), points);
    };
    const Outcome one_mesh = mesh("1"), one_eval = eval("1");
    CHECK(one_mesh.exit == 0);
    CHECK(one_mesh.out.size() > 10000);
    CHECK(std::count(one_eval.out.begin(), one_eval.out.end(), '\n') == 40000);
    for (const char* threads : {"2", "7"}) {
        CHECK(mesh(threads).out == one_mesh.out);
        CHECK(eval(threads).out == one_eval.out);
    }
}

TEST_CASE("engines give the same bytes") {
    const ScratchFolder folder;
    write_bytes(folder.path() / "m.hf",
                "my_model(x[3], a[1], s[2]) { s = [1, 2]; s[2] = sin(x[2]) * x[1] ^ 2.5;\n"
                "my_model = (25 - x[1]^2 - x[2]^2) & x[3] | sqrt(x[1]); }\n");
    std::string points;
    for (int i = -2000; i < 2000; ++i)
        points += std::to_string(i * 0.01) + "," + std::to_string(i * 0.37 + 1) + ",1e-3\n";
    const auto eval = [&](const char* engine) {
        return run({"eval", "m.hf", "--points", "-", "--gradient", "--engine", engine}, folder.path(),
                   points);
    };
    const Outcome vm = eval("vm");
    CHECK(vm.exit == 0);
    CHECK(vm.out.find("undefined") != std::string::npos);
    CHECK(vm.out == eval("reference").out);
}

TEST_CASE("a result that cannot be written is exit code 4") {
    const ScratchFolder folder;
    write_bytes(folder.path() / "m.hf", sphere);
    Process process({"mesh", "m.hf", "-o", "/dev/full", "--format", "stl", "--grid", "8"}, folder.path());
    const Outcome outcome = process.wait();
    CHECK(outcome.exit == 4);
}
