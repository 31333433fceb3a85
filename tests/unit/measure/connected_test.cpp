#include "frep/measure/connected.h"

#include <doctest/doctest.h>

using namespace frep::measuring;

namespace {
using Samples = std::vector<std::array<std::uint16_t, 3>>;
}

TEST_CASE("samples near each other are one part") {
    CHECK(connected_parts({}).empty());
    for (const Samples& pair : {Samples{{10, 10, 10}, {11, 10, 10}}, Samples{{10, 10, 10}, {12, 8, 12}},
                                Samples{{11, 11, 11}, {12, 12, 12}}, Samples{{0, 0, 0}, {2, 2, 2}},
                                Samples{{7, 1, 9}, {5, 3, 7}}}) {
        CHECK(connected_parts(pair).size() == 1);
    }
    for (const Samples& pair : {Samples{{10, 10, 10}, {14, 10, 10}}, Samples{{10, 10, 10}, {10, 14, 10}},
                                Samples{{10, 10, 10}, {11, 11, 14}}, Samples{{0, 0, 1}, {65535, 0, 0}},
                                Samples{{65535, 0, 0}, {0, 2, 0}}}) {
        CHECK(connected_parts(pair).size() == 2);
    }
}

TEST_CASE("parts come with the largest first, and hold every sample once") {
    Samples samples{{100, 100, 100}};
    for (std::uint16_t i = 0; i < 40; ++i) samples.push_back({static_cast<std::uint16_t>(2 * i), 5, 6});
    for (std::uint16_t i = 0; i < 20; ++i) samples.push_back({5, 50, static_cast<std::uint16_t>(2 * i)});
    const auto parts = connected_parts(samples);
    REQUIRE(parts.size() == 3);
    CHECK(parts[0].size() == 40);
    CHECK(parts[1].size() == 20);
    CHECK(parts[2] == Samples{{100, 100, 100}});
}
