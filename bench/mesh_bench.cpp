// Meshing of .vm models on [-1, 1]^3: the uniform mesher and dual contouring, in turn in one run, on one
// thread. Prints a line a model and size: CPU milliseconds (median of the rounds) and triangles of each, and
// the ratio of the times. Usage: bench_mesh ROUNDS CELLS[,CELLS...] MODEL.vm...
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "frep/frep.h"

namespace {

using namespace frep;

double cpu_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Timed {
    std::vector<double> ms;
    std::size_t triangles = 0;
};

/// Runs one of the meshers once.
template <class Mesher>
bool run(Mesher mesher, const SampledField& field, const ContourOptions& options, Timed& timed) {
    Job job;
    job.threads = 1;
    const double start = cpu_ms();
    const Result<ContourResult> result = mesher(field, options, job);
    timed.ms.push_back(cpu_ms() - start);
    if (!result) {
        fmt::print(stderr, "{}\n", result.error().message);
        return false;
    }
    timed.triangles = result->mesh.triangles.size();
    return true;
}

bool measure(const std::string& path, const SampledField& field, int cells, int rounds) {
    const ContourOptions options{.bounds = Box3::cube(1), .cells = cells};
    Timed uniform, adaptive;
    for (int i = 0; i < rounds; ++i) {
        if (!run(contour_cells, field, options, uniform)) return false;
        if (!run(contour_adaptive, field, options, adaptive)) return false;
    }
    fmt::print("{:<40} N={:<5} cells {:9.1f} ms {:9} tri   adaptive {:9.1f} ms {:9} tri   ratio {:.2f}\n",
               path, cells, median(uniform.ms), uniform.triangles, median(adaptive.ms), adaptive.triangles,
               median(adaptive.ms) / median(uniform.ms));
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        fmt::print(stderr, "usage: bench_mesh ROUNDS CELLS[,CELLS...] MODEL.vm...\n");
        return 2;
    }
    const int rounds = std::max(1, std::atoi(argv[1]));
    std::vector<int> sizes;
    for (std::string rest = argv[2]; !rest.empty();) {
        const std::size_t comma = rest.find(',');
        sizes.push_back(std::atoi(rest.substr(0, comma).c_str()));
        rest = comma == std::string::npos ? "" : rest.substr(comma + 1);
    }
    for (int i = 3; i < argc; ++i) {
        const auto model = compile_file(argv[i]);
        if (!model) {
            fmt::print(stderr, "{}\n", model.error().message);
            return 1;
        }
        const auto field = model->field();
        auto evaluator = field ? make_evaluator(*field) : field.error();
        if (!evaluator) {
            fmt::print(stderr, "{}\n", evaluator.error().message);
            return 1;
        }
        const AxisMap map = AxisMap::standard((*evaluator)->coordinates());
        const auto sampled = make_sampled_field(std::move(*evaluator), map);
        for (const int cells : sizes) {
            if (!measure(argv[i], **sampled, cells, rounds)) return 1;
        }
    }
    return 0;
}
