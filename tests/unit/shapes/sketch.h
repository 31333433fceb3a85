// A model under construction for the tests of the library: calls of functions through the library table, and
// an evaluator of graphs without regions for every number type, node by node.
#pragma once

#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "frep/field/meaning.h"
#include "frep/shapes/library.h"

namespace frep::test {

using Items = std::vector<Expression>;

/// One argument of a call.
struct Argument {
    Argument(Expression number) : value{number, {}, {}} {}
    Argument(double number) : plain(number), is_plain(true) {}
    Argument(int number) : Argument(static_cast<double>(number)) {}
    Argument(Items& items) : array(&items) { value.items = items; }
    Argument(const char* text) { value.text = text; }

    shapes::ArgumentValue value;
    double plain = 0.0;
    bool is_plain = false;
    Items* array = nullptr;
};

class Sketch {
  public:
    Sketch() : build{graph, [this](const std::string& message) { warnings.push_back(message); }, {}} {
        for (int i = 0; i < 3; ++i) x.push_back({graph, graph.coordinate(i)});
    }
    Sketch(const Sketch&) = delete;

    Expression number(double value) { return build.constant(value); }
    Items list(std::initializer_list<double> values) {
        Items items;
        for (const double value : values) items.push_back(number(value));
        return items;
    }

    /// Calls the function of that name with as many arguments; arrays are changed in place.
    Expression call(std::string_view name, std::vector<Argument> arguments) {
        for (const shapes::LibraryFunction& function : shapes::find_functions(name)) {
            if (function.arguments.size() != arguments.size()) continue;
            std::vector<shapes::ArgumentValue> values;
            for (Argument& a : arguments) {
                if (a.is_plain) a.value.number = number(a.plain);
                values.push_back(a.value);
            }
            const Expression result = function.invoke(build, values);
            for (std::size_t i = 0; i < arguments.size(); ++i)
                if (function.arguments[i].kind == shapes::ArgumentKind::array_in_out)
                    *arguments[i].array = values[i].items;
            return result;
        }
        throw std::string("no function ") + std::string(name);
    }

    Graph graph;
    std::vector<std::string> warnings;
    shapes::Build build;
    Items x;
};

/// The value of a node; coordinates beyond those given are 0.
template <class T>
T evaluate(const Expression& root, const std::vector<T>& point) {
    const Graph& graph = root.graph();
    std::vector<T> values(root.id() + 1);
    const NodeId roots[] = {root.id()};
    const std::vector<bool> needed = reachable(graph, roots);
    for (NodeId id = 0; id <= root.id(); ++id) {
        if (!needed[id]) continue;
        const Node& node = graph.node(id);
        if (node.op == Op::constant) {
            values[id] = math::constant<T>(graph.constant_of(id));
        } else if (node.op == Op::coordinate) {
            values[id] = node.payload < point.size() ? point[node.payload] : math::constant<T>(0.0);
        } else if (node.op == Op::undefined) {
            values[id] = math::constant<T>(math::quiet_nan);
        } else {
            std::vector<T> arguments;
            for (const NodeId a : graph.arguments(id)) arguments.push_back(values[a]);
            const auto block =
                info(node.op).kind == OpKind::block ? graph.block_of(id) : std::span<const double>();
            values[id] = meaning<T>(node.op, arguments, block);
        }
    }
    return values[root.id()];
}

inline double at(const Expression& f, double x, double y, double z) { return evaluate<double>(f, {x, y, z}); }

/// F and its gradient.
inline math::Dual<double> gradient_at(const Expression& f, double x, double y, double z) {
    using Dual = math::Dual<double>;
    return evaluate<Dual>(f, {Dual::variable(x, 0), Dual::variable(y, 1), Dual::variable(z, 2)});
}

struct Box {
    math::Interval x, y, z;
};
inline math::Interval range_over(const Expression& f, const Box& box) {
    return evaluate<math::Interval>(f, {box.x, box.y, box.z});
}

inline std::string content_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

}  // namespace frep::test
