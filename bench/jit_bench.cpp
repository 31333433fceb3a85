// Native code against the vm: dense throughput on models in .vm form, points that lie in the first cache, and
// the time to compile. All contenders see the same points in turn within one round; figures are medians over
// rounds of CPU time. Arguments: .vm files. Prints a line a model, type of numbers and instruction set.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "frep/eval/batch_vm.h"
#include "frep/eval/evaluator.h"
#include "frep/eval/native_code.h"
#include "frep/lang/vm_text.h"

namespace {

using namespace frep;

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

constexpr std::size_t point_count = 1024;
constexpr int rounds = 15;

template <class Real>
struct Points {
    std::vector<Real> x, y, z, f;
    Points() : x(point_count), y(point_count), z(point_count), f(point_count) {
        for (std::size_t i = 0; i < point_count; ++i) {
            x[i] = static_cast<Real>(-1.0 + 2.0 * static_cast<double>(i % 32) / 31.0);
            y[i] = static_cast<Real>(-1.0 + 2.0 * static_cast<double>(i / 32) / 31.0);
            z[i] = static_cast<Real>(-1.0 + 2.0 * static_cast<double>(i * 7 % point_count) / point_count);
        }
    }
};

struct Contender {
    std::string name;
    std::function<void()> run;
    std::size_t points = point_count;
    std::size_t repeats = 1;
    std::vector<double> seconds = {};
};

/// A block of a dense grid, `size` samples an axis.
template <class Real>
void add_grid(std::vector<Contender>& all, std::shared_ptr<NativeCode<Real>> code, Isa isa,
              std::size_t size) {
    auto axis = std::make_shared<std::vector<Real>>(size);
    for (std::size_t i = 0; i < size; ++i)
        (*axis)[i] = static_cast<Real>(-0.5 + static_cast<double>(i) / static_cast<double>(size));
    auto out = std::make_shared<std::vector<Real>>(size * size * size);
    all.push_back({fmt::format("{:6} {:6} domain, grid of {}^3", sizeof(Real) == 4 ? "float" : "double",
                               name_of(isa), size),
                   [=] {
                       code->run(NativeGrid<Real>{*axis, *axis, *axis, out->data(), size, size * size});
                   },
                   size * size * size});
}

template <class Real>
void add_batch_vm(std::vector<Contender>& all, const ClauseTape& tape, Points<Real>& points) {
    auto packed = std::make_shared<ClauseTape>(tape);
    pack_rows(*packed);
    auto vm = std::make_shared<BatchVm<Real>>();
    all.push_back({fmt::format("{:6} BatchVm", sizeof(Real) == 4 ? "float" : "double"), [=, &points] {
                       const Real* const in[3] = {points.x.data(), points.y.data(), points.z.data()};
                       const auto coordinates = static_cast<std::size_t>(packed->data->coordinates);
                       vm->values(*packed, {in, coordinates}, point_count, points.f.data());
                   }});
}

template <class Real>
void add_native(std::vector<Contender>& all, const ClauseTape& tape, Points<Real>& points, Isa isa,
                bool domain) {
    static const std::vector<math::Interval> cube(3, math::Interval(-1.0, 1.0));
    NativeOptions options{isa, {}};
    if (domain) options.domain = {cube.data(), static_cast<std::size_t>(tape.data->coordinates)};
    std::vector<double> compile_times;
    std::shared_ptr<NativeCode<Real>> code;
    for (int i = 0; i < 9; ++i) {
        const double start = cpu_seconds();
        auto made = NativeCode<Real>::compile(tape, options);
        compile_times.push_back(cpu_seconds() - start);
        if (!made) return;
        code = std::make_shared<NativeCode<Real>>(std::move(*made));
    }
    const NativeStatistics& s = code->statistics();
    const double per_clause = 1e9 * median(compile_times) / static_cast<double>(tape.clauses.size());
    all.push_back(
        {fmt::format("{:6} {:6}{:7} compile {:8.1f} us ({:5.1f} ns a clause) {:6} instructions {:7} bytes",
                     sizeof(Real) == 4 ? "float" : "double", name_of(isa), domain ? " domain" : "",
                     1e6 * median(compile_times), per_clause, s.instructions, s.bytes),
         [code, &points] {
             const Real* const in[3] = {points.x.data(), points.y.data(), points.z.data()};
             code->run(in, point_count, points.f.data());
         }});
    if (!domain || tape.data->coordinates != 3) return;
    add_grid(all, code, isa, 33);
    add_grid(all, code, isa, 64);
}

void measure(const std::string& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    const Source source(path, text.str());
    lang::Reporter reporter(source);
    const auto field = lang::parse_vm_text(source, reporter);
    if (!field) return;
    const auto tape = make_clause_tape(*field);
    if (!tape) return;
    Points<double> doubles;
    Points<float> floats;
    std::vector<Contender> all;
    auto vm = make_evaluator(*field, {.engine = Engine::vm});
    all.push_back({"double vm", [&] {
                       const double* const in[3] = {doubles.x.data(), doubles.y.data(), doubles.z.data()};
                       double* const out[1] = {doubles.f.data()};
                       (*vm)->values({in, static_cast<std::size_t>(field->coordinates)}, point_count, out);
                   }});
    add_batch_vm(all, *tape, doubles);
    add_batch_vm(all, *tape, floats);
    for (const Isa isa : {Isa::avx2, Isa::avx512}) {
        for (const bool domain : {false, true}) {
            add_native(all, *tape, doubles, isa, domain);
            add_native(all, *tape, floats, isa, domain);
        }
    }
    for (Contender& c : all) {
        const double start = cpu_seconds();
        c.run();
        c.repeats = static_cast<std::size_t>(1 + 0.002 / std::max(cpu_seconds() - start, 1e-7));
    }
    for (int round = 0; round < rounds; ++round) {
        for (Contender& c : all) {
            const double start = cpu_seconds();
            for (std::size_t i = 0; i < c.repeats; ++i) c.run();
            c.seconds.push_back((cpu_seconds() - start) / static_cast<double>(c.repeats));
        }
    }
    fmt::print("{}: {} clauses\n", path.substr(path.rfind('/') + 1), tape->clauses.size());
    for (const Contender& c : all) {
        const double mega = 1e-6 * static_cast<double>(c.points) / median(c.seconds);
        fmt::print("  {:9.2f} Mpts/s {:7.2f} ops/ns {:7.1f} x  {}\n", mega,
                   1e-3 * mega * static_cast<double>(tape->clauses.size()),
                   mega * median(all[0].seconds) / (1e-6 * point_count), c.name);
    }
}

}  // namespace

int main(int count, char** arguments) {
    for (int i = 1; i < count; ++i) measure(arguments[i]);
    return 0;
}
