// Dense throughput of BatchVm on `.vm` models, by number format, instruction set and size of the batches,
// against the register tape vm (vm.h) on the same points in the same run; CPU time of the thread, medians.
// Usage: bench_batch MODEL.vm ... Prints a table: millions of points a second, operations a nanosecond
// (clauses times points), and the ratio to the register tape in binary64.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "frep/eval/batch_vm.h"
#include "frep/eval/evaluator.h"
#include "frep/eval/tape.h"
#include "frep/eval/vm.h"
#include "frep/lang/vm_text.h"

namespace {

using namespace frep;

constexpr std::size_t total_points = 1024;

double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Points of a cube, in columns.
template <class Real>
struct Points {
    std::vector<Real> columns[3], f;

    Points() : f(total_points) {
        std::uint64_t state = 1;
        for (auto& column : columns) {
            for (std::size_t i = 0; i < total_points; ++i) {
                state = state * 6364136223846793005u + 1442695040888963407u;
                column.push_back(static_cast<Real>(static_cast<double>(state >> 40) * 0x1p-23 - 1));
            }
        }
    }
};

/// Seconds of one call of `work`: the median of several measurements of at least 4 ms.
template <class Work>
double seconds(Work work) {
    work();
    int calls = 1;
    for (double took = 0; took < 4e-3; calls *= 2) {
        const double start = now();
        for (int i = 0; i < calls; ++i) work();
        took = now() - start;
    }
    std::vector<double> times;
    for (int run = 0; run < 9; ++run) {
        const double start = now();
        for (int i = 0; i < calls; ++i) work();
        times.push_back((now() - start) / calls);
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

double register_tape_seconds(const Field& field) {
    const auto tape = make_tape(field, {&field.value, 1}, {});
    if (!tape) return 0;
    Machine<math::Lanes> machine(*tape, 1000);
    Points<double> points;
    return seconds([&] {
        const std::size_t batch = machine.width() * 4;
        for (std::size_t start = 0; start < total_points; start += batch) {
            const std::size_t elements = std::min(batch, total_points - start) / 4;
            for (const std::uint32_t i : tape->inputs)
                for (std::size_t e = 0; e < elements; ++e)
                    machine.input(i)[e] = math::Lanes::load(points.columns[i].data() + start + 4 * e);
            machine.run(elements);
            const auto row = machine.output(0);
            for (std::size_t e = 0; e < elements; ++e) row[e].store(points.f.data() + start + 4 * e);
        }
    });
}

/// The same for values and derivatives.
double register_tape_gradient_seconds(const Field& field) {
    using Dual = math::Dual<math::Lanes>;
    const auto tape = make_tape(field, {&field.value, 1}, {});
    if (!tape) return 0;
    Machine<Dual> machine(*tape, 1000);
    Points<double> points;
    std::vector<double> slopes(3 * total_points);
    return seconds([&] {
        const std::size_t batch = machine.width() * 4;
        for (std::size_t start = 0; start < total_points; start += batch) {
            const std::size_t elements = std::min(batch, total_points - start) / 4;
            for (const std::uint32_t i : tape->inputs)
                for (std::size_t e = 0; e < elements; ++e)
                    machine.input(i)[e] = Dual::variable(
                        math::Lanes::load(points.columns[i].data() + start + 4 * e), static_cast<int>(i));
            machine.run(elements);
            const auto row = machine.output(0);
            for (std::size_t e = 0; e < elements; ++e) {
                row[e].value.store(points.f.data() + start + 4 * e);
                for (std::size_t i = 0; i < 3; ++i)
                    row[e].d[i].store(slopes.data() + i * total_points + start + 4 * e);
            }
        }
    });
}

struct Report {
    std::string model;
    std::size_t clauses;
    double old_values, old_gradients;  ///< seconds of the register tape

    void line(const char* what, Isa isa, std::size_t batch, double took, double old) const {
        const double rate = static_cast<double>(total_points) / took;
        fmt::print("{:16} {:>6} {:18} {:7} {:>5} {:>10.2f} {:>8.2f} {:>7.2f}\n", model, clauses, what,
                   name_of(isa), batch, 1e-6 * rate, 1e-9 * rate * static_cast<double>(clauses), old / took);
    }
};

template <class Real>
void measure(const Report& report, const ClauseTape& tape, Isa isa) {
    set_isa_limit(isa);
    BatchVm<Real> vm;
    set_isa_limit(Isa::avx512);
    Points<Real> points;
    const bool wide = sizeof(Real) == 8;
    for (const std::size_t batch : {total_points, std::size_t{256}, std::size_t{64}, std::size_t{16}}) {
        const double took = seconds([&] {
            for (std::size_t start = 0; start < total_points; start += batch) {
                const Real* in[3] = {points.columns[0].data() + start, points.columns[1].data() + start,
                                     points.columns[2].data() + start};
                vm.values(tape, in, batch, points.f.data() + start);
            }
        });
        report.line(wide ? "binary64" : "binary32", isa, batch, took, report.old_values);
    }
    std::vector<Real> slopes[3];
    for (auto& column : slopes) column.resize(total_points);
    Real* const out[3] = {slopes[0].data(), slopes[1].data(), slopes[2].data()};
    const Real* in[3] = {points.columns[0].data(), points.columns[1].data(), points.columns[2].data()};
    const double took = seconds([&] { vm.gradients(tape, in, total_points, points.f.data(), out); });
    report.line(wide ? "binary64 gradients" : "binary32 gradients", isa, total_points, took,
                report.old_gradients);
}

}  // namespace

int main(int argc, char** argv) {
    fmt::print("{:16} {:>6} {:18} {:7} {:>5} {:>10} {:>8} {:>7}\n", "model", "ops", "what", "set", "batch",
               "Mpts/s", "ops/ns", "ratio");
    for (int k = 1; k < argc; ++k) {
        const std::string path = argv[k];
        std::ifstream file(path, std::ios::binary);
        const Source source(path, std::string(std::istreambuf_iterator<char>(file), {}));
        lang::Reporter reporter(source);
        const auto field = lang::parse_vm_text(source, reporter);
        auto tape = field ? make_clause_tape(*field) : std::nullopt;
        if (!tape) {
            fmt::print("cannot read {}\n", path);
            return 1;
        }
        pack_rows(*tape);
        const std::size_t slash = path.rfind('/');
        const Report report{slash == std::string::npos ? path : path.substr(slash + 1), tape->clauses.size(),
                            register_tape_seconds(*field), register_tape_gradient_seconds(*field)};
        report.line("register tape", Isa::sse2, total_points, report.old_values, report.old_values);
        report.line("its gradients", Isa::sse2, total_points, report.old_gradients, report.old_gradients);
        for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512}) {
            if (isa > machine_isa()) continue;
            measure<double>(report, *tape, isa);
            measure<float>(report, *tape, isa);
        }
    }
    return 0;
}
