// parallel_for calls every index once, stops when cancelled, and run_on_stack gives the room it promises.
#include <doctest/doctest.h>

#include <vector>

#include "frep/base/parallel.h"
#include "frep/base/result.h"
#include "frep/base/stack.h"

using namespace frep;

TEST_CASE("every index is called once, for any number of threads") {
    for (int threads : {1, 2, 8}) {
        Job job;
        job.threads = threads;
        std::vector<int> calls(1000, 0);
        parallel_for(job, calls.size(), [&](std::size_t i) { ++calls[i]; });
        CHECK(calls == std::vector<int>(1000, 1));
    }
}

TEST_CASE("a cancelled job stops") {
    Job job;
    job.threads = 1;
    int calls = 0;
    parallel_for(job, 1000, [&](std::size_t) {
        if (++calls == 10) job.cancel();
    });
    CHECK(calls == 10);
}

namespace {

int depth_reached(int depth) {
    volatile char room[1024];
    room[0] = static_cast<char>(depth);
    return depth == 0 ? room[0] : depth_reached(depth - 1) + 1;
}

}  // namespace

TEST_CASE("a deep recursion fits a large stack") {
    int depth = 0;
    run_on_stack(std::size_t{128} << 20, [&] { depth = depth_reached(50'000); });
    CHECK(depth == 50'000);
}

TEST_CASE("results carry a value or an error") {
    const Result<int> good = 3;
    const Result<int> bad = Error{ErrorKind::io, "no such file"};
    REQUIRE(good);
    CHECK(*good == 3);
    CHECK_FALSE(bad);
    CHECK(bad.error().message == "no such file");
    CHECK(static_cast<bool>(Status()));
}
