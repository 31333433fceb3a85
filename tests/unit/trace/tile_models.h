// Models of the tests of tile pictures, in space: folds with min and max, with R-functions, smooth and
// undefined ones.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frep/eval/clause_tape.h"
#include "frep/field/expression.h"

namespace frep_test {

using namespace frep;

struct TileModel {
    std::string name;
    Field field;
    ClauseTape tape;
};

template <class Build>
TileModel tile_model(std::string name, Build build) {
    auto graph = std::make_shared<Graph>();
    const Expression f =
        build(Expression(*graph, graph->coordinate(0)), Expression(*graph, graph->coordinate(1)),
              Expression(*graph, graph->coordinate(2)));
    TileModel model{std::move(name), {}, {}};
    model.field.value = f.id();
    model.field.graph = std::move(graph);
    model.tape = *make_clause_tape(model.field);
    return model;
}

/// Numbers in -1..1, the same in every run.
struct TileRandom {
    std::uint32_t seed = 7;
    double operator()() {
        seed = seed * 1664525u + 1013904223u;
        return static_cast<double>(seed >> 8) / 8388608.0 - 1;
    }
};

/// `count` balls, every third one taken away from what is there.
template <class Union, class Intersection>
Expression balls(Expression x, Expression y, Expression z, int count, Union join, Intersection meet) {
    TileRandom random;
    Expression f = Expression::constant(x, -1);
    for (int i = 0; i < count; ++i) {
        const double r = 0.2 + 0.1 * random();
        const Expression ball =
            r - sqrt(square(x - random()) + square(y - random()) + square(z - 0.5 * random()));
        f = i % 3 == 2 ? meet(f, -ball) : join(f, ball);
    }
    return f;
}

inline std::vector<TileModel> tile_models() {
    std::vector<TileModel> all;
    const auto add = [&all](TileModel model) { all.push_back(std::move(model)); };
    const auto low = [](Expression a, Expression b) { return min(a, b); };
    const auto high = [](Expression a, Expression b) { return max(a, b); };
    const auto both = [](Expression a, Expression b) { return r_and(a, b); };
    const auto either = [](Expression a, Expression b) { return r_or(a, b); };
    add(tile_model("ball",
                   [](auto x, auto y, auto z) { return 0.8 - sqrt(square(x) + square(y) + square(z)); }));
    add(tile_model("min and max", [=](auto x, auto y, auto z) { return balls(x, y, z, 60, high, low); }));
    add(tile_model("R-functions", [=](auto x, auto y, auto z) { return balls(x, y, z, 60, either, both); }));
    add(tile_model("waves", [](auto x, auto y, auto z) {
        return 0.3 -
               abs(sin(7.0 * x) * cos(7.0 * y) + sin(7.0 * y) * cos(7.0 * z) + sin(7.0 * z) * cos(7.0 * x));
    }));
    add(tile_model("undefined", [=](auto x, auto y, auto z) {
        return max(sqrt(0.3 - square(x) - y) - 0.4, 0.3 - sqrt(square(x + 0.4) + square(y) + square(z)));
    }));
    add(tile_model("everywhere", [](auto x, auto, auto) { return Expression::constant(x, 1); }));
    add(tile_model("nowhere", [](auto x, auto, auto) { return -1.0 - square(x); }));
    return all;
}

}  // namespace frep_test
