// libfive on the tasks of `frep bench`, for the table of docs/performance.md. Built by hand against a libfive
// tree that lies somewhere else (docs/performance.md says how); nothing of libfive is part of this project.
//   libfive_bench MODEL.vm TASK SIZE [REPEAT]     TASK: load picture text-to-picture dense depth mesh
// Prints the median, least and greatest CPU time in ms, one thread.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <unordered_map>
#include <vector>

#include "libfive/eval/eval_array.hpp"
#include "libfive/eval/evaluator.hpp"
#include "libfive/render/brep/mesh.hpp"
#include "libfive/render/brep/region.hpp"
#include "libfive/render/brep/settings.hpp"
#include "libfive/render/discrete/heightmap.hpp"
#include "libfive/render/discrete/voxels.hpp"
#include "libfive/tree/tree.hpp"

using namespace libfive;

namespace {

double cpu_ms() {
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    const auto ms = [](const timeval& t) {
        return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
    };
    return ms(use.ru_utime) + ms(use.ru_stime);
}

Tree parse(const std::string& text) {
    static const std::unordered_map<std::string, Opcode::Opcode> unary = {
        {"neg", Opcode::OP_NEG},       {"abs", Opcode::OP_ABS}, {"sqrt", Opcode::OP_SQRT},
        {"square", Opcode::OP_SQUARE}, {"sin", Opcode::OP_SIN}, {"cos", Opcode::OP_COS},
        {"exp", Opcode::OP_EXP},       {"ln", Opcode::OP_LOG},  {"recip", Opcode::OP_RECIP}};
    static const std::unordered_map<std::string, Opcode::Opcode> binary = {
        {"add", Opcode::OP_ADD}, {"sub", Opcode::OP_SUB}, {"mul", Opcode::OP_MUL}, {"div", Opcode::OP_DIV},
        {"min", Opcode::OP_MIN}, {"max", Opcode::OP_MAX}, {"mod", Opcode::OP_MOD}};
    std::unordered_map<std::string, Tree> known;
    Tree last = Tree(0.0f);
    std::istringstream lines(text);
    std::string line, name, op, a, b;
    while (std::getline(lines, line)) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        words >> name >> op;
        if (op == "const") {
            float value = 0;
            words >> value;
            last = Tree(value);
        } else if (op == "var-x") {
            last = Tree::X();
        } else if (op == "var-y") {
            last = Tree::Y();
        } else if (op == "var-z") {
            last = Tree::Z();
        } else if (unary.count(op)) {
            words >> a;
            last = Tree::unary(unary.at(op), known.at(a));
        } else {
            words >> a >> b;
            last = Tree::binary(binary.at(op), known.at(a), known.at(b));
        }
        known.insert_or_assign(name, last);
    }
    return last;
}

struct Sink {
    double value = 0;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) return 2;
    std::ifstream file(argv[1]);
    std::stringstream buffer;
    buffer << file.rdbuf();
    const std::string text = buffer.str(), task = argv[2];
    const int size = std::atoi(argv[3]), repeat = argc > 4 ? std::atoi(argv[4]) : 5;
    const Tree tree = parse(text);
    const std::atomic_bool abort(false);
    Sink sink;
    std::vector<double> times;
    const float per_unit = static_cast<float>(size) / 2;
    const bool flat = task == "picture" || task == "text-to-picture";
    for (int n = 0; n < repeat; ++n) {
        double start = cpu_ms();
        if (task == "load") {
            const Tree t = parse(text).optimized();
            Evaluator e(t);
            sink.value += e.value({0, 0, 0});
        } else if (flat || task == "depth") {
            const Voxels voxels =
                flat ? Voxels({-1, -1, 0}, {1, 1, 0}, per_unit) : Voxels({-1, -1, -1}, {1, 1, 1}, per_unit);
            const Tree t = task == "text-to-picture" ? parse(text) : tree;
            const auto map = Heightmap::render(t, voxels, abort, 1);
            sink.value += map->depth(0, 0);
        } else if (task == "dense") {
            ArrayEvaluator e(tree.optimized());
            start = cpu_ms();
            for (int k = 0; k < size; ++k) {  // batches of 256
                for (int i = 0; i < 256; ++i) {
                    const float u = static_cast<float>(i) / 256 * 2 - 1;
                    e.set({u, u * 0.7f + 0.1f, 0.3f - u * 0.2f}, static_cast<size_t>(i));
                }
                sink.value += e.values(256)(0);
            }
        } else if (task == "mesh") {
            BRepSettings settings;
            settings.workers = 1;
            settings.min_feature = 2.0 / size;
            settings.max_err = 1e-8;
            const auto mesh = Mesh::render(tree, Region<3>({-1, -1, -1}, {1, 1, 1}), settings);
            sink.value += static_cast<double>(mesh->branes.size());
            if (n == 0) std::printf("triangles %zu\n", mesh->branes.size());
        }
        times.push_back(cpu_ms() - start);
    }
    std::sort(times.begin(), times.end());
    std::printf("%s %s %d: median %.2f ms, %.2f .. %.2f (%g)\n", argv[1], argv[2], size,
                times[times.size() / 2], times.front(), times.back(), sink.value);
}
