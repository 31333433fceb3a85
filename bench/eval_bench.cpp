// Throughput of the vm against the reference engine on built graphs: sphere, a union of 100 spheres, gyroid.
// Both engines see the same points in turn in one run; the ratio is the median over pairs of runs, so that a
// busy machine slows both. Prints JSON.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "frep/eval/evaluator.h"
#include "frep/field/expression.h"

namespace {

using namespace frep;
using Clock = std::chrono::steady_clock;

struct Model {
    std::string name;
    Field field;
};

Expression sphere_of(Expression x, Expression y, Expression z, double cx, double cy, double cz, double r) {
    return r * r - (square(x - cx) + square(y - cy) + square(z - cz));
}

template <class Build>
Model model(std::string name, Build build) {
    auto graph = std::make_shared<Graph>();
    const Expression f =
        build(Expression(*graph, graph->coordinate(0)), Expression(*graph, graph->coordinate(1)),
              Expression(*graph, graph->coordinate(2)));
    Model made{std::move(name), {}};
    made.field.value = f.id();
    made.field.graph = std::move(graph);
    return made;
}

std::vector<Model> models() {
    std::vector<Model> all;
    all.push_back(model("sphere", [](auto x, auto y, auto z) { return sphere_of(x, y, z, 0, 0, 0, 1.5); }));
    all.push_back(model("union of 100 spheres", [](auto x, auto y, auto z) {
        Expression f = sphere_of(x, y, z, 0, 0, 0, 0.5);
        for (int i = 1; i < 100; ++i)
            f = r_or(f, sphere_of(x, y, z, 0.03 * i - 1.5, 0.02 * (i % 10), 0.1 * (i % 7), 0.25));
        return f;
    }));
    all.push_back(model("gyroid", [](auto x, auto y, auto z) {
        return sin(4.0 * x) * cos(4.0 * y) + sin(4.0 * y) * cos(4.0 * z) + sin(4.0 * z) * cos(4.0 * x);
    }));
    return all;
}

struct Points {
    std::vector<double> x, y, z, f;

    explicit Points(std::size_t count) : x(count), y(count), z(count), f(count) {
        for (std::size_t i = 0; i < count; ++i) {
            x[i] = -2.0 + 4.0 * static_cast<double>(i % 32) / 31.0;
            y[i] = -2.0 + 4.0 * static_cast<double>(i / 32 % 32) / 31.0;
            z[i] = -2.0 + 4.0 * static_cast<double>(i / 1024) / static_cast<double>(count / 1024 + 1);
        }
    }
};

/// Seconds for one call over all points.
double seconds(Evaluator& evaluator, Points& points) {
    const double* in[3] = {points.x.data(), points.y.data(), points.z.data()};
    double* out[1] = {points.f.data()};
    const auto start = Clock::now();
    evaluator.values(in, points.x.size(), out);
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

int main() {
    constexpr int pairs = 15;
    Points points(32 * 1024);
    const auto count = static_cast<double>(points.x.size());
    fmt::print("{{\"points\": {}, \"pairs\": {}, \"models\": [", points.x.size(), pairs);
    bool first = true;
    for (const Model& model : models()) {
        auto reference = make_evaluator(model.field, {.engine = Engine::reference});
        auto vm = make_evaluator(model.field, {.engine = Engine::vm});
        if (!reference || !vm) return 1;
        std::vector<double> ratios, reference_times, vm_times;
        seconds(**vm, points);
        for (int i = 0; i < pairs; ++i) {
            reference_times.push_back(seconds(**reference, points));
            vm_times.push_back(seconds(**vm, points));
            ratios.push_back(reference_times.back() / vm_times.back());
        }
        fmt::print(
            "{}\n  {{\"name\": \"{}\", \"ratio\": {:.2f}, \"vm_ns_per_point\": {:.2f}, "
            "\"reference_ns_per_point\": {:.2f}}}",
            first ? "" : ",", model.name, median(ratios), 1e9 * median(vm_times) / count,
            1e9 * median(reference_times) / count);
        first = false;
    }
    fmt::print("\n]}}\n");
    return 0;
}
