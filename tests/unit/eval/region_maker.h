// Regions written by hand, for the tests of regions.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "frep/field/field.h"

namespace frep_test {

using namespace frep;
using Kind = RegionStatement::Kind;

/// Writes a region by hand.
struct Maker {
    std::shared_ptr<Region> region = std::make_shared<Region>();

    explicit Maker(std::uint32_t cells) { region->cell_count = cells; }
    Graph& body() { return region->body; }
    NodeId cell(std::uint32_t number) { return body().make(Op::cell, {}, number); }
    NodeId number(double value) { return body().constant(value); }
    NodeId make(Op op, std::initializer_list<NodeId> arguments) { return body().make(op, arguments); }
    NodeId load(std::uint32_t array, NodeId index) { return body().make(Op::load, {index}, array); }

    std::uint32_t add(RegionStatement statement) {
        region->statements.push_back(std::move(statement));
        return static_cast<std::uint32_t>(region->statements.size() - 1);
    }
    std::uint32_t assign(std::vector<std::pair<std::uint32_t, NodeId>> assignments) {
        RegionStatement s;
        s.assignments = std::move(assignments);
        return add(std::move(s));
    }
    std::uint32_t store(std::uint32_t array, NodeId index, NodeId value) {
        RegionStatement s;
        s.kind = Kind::store;
        s.array = array;
        s.index = index;
        s.value = value;
        return add(std::move(s));
    }
    std::uint32_t branch(NodeId condition, std::vector<std::uint32_t> first,
                         std::vector<std::uint32_t> second) {
        RegionStatement s;
        s.kind = Kind::branch;
        s.condition = condition;
        s.first = std::move(first);
        s.second = std::move(second);
        return add(std::move(s));
    }
    std::uint32_t loop(NodeId condition, std::vector<std::uint32_t> first) {
        RegionStatement s;
        s.kind = Kind::loop;
        s.condition = condition;
        s.first = std::move(first);
        return add(std::move(s));
    }
};

/// A field of coordinates x, y: cell `result` of the region started with (guard, x, y) in cells 0 and 1.
inline Field field_of(Maker& maker, std::uint32_t result, double guard = 1.0) {
    maker.region->inputs = {0, 1};
    auto graph = std::make_shared<Graph>();
    const NodeId arguments[3] = {graph->constant(guard), graph->coordinate(0), graph->coordinate(1)};
    const NodeId region = graph->make_region(maker.region, arguments);
    Field field;
    field.coordinates = 2;
    field.value = graph->make(Op::output, {region}, result);
    field.graph = std::move(graph);
    return field;
}

/// z = z^2 + c from 0 while |z|^2 < 4 and fewer than `most` steps; cells: cx cy zx zy steps.
inline Maker mandelbrot(double most) {
    Maker m(5);
    const NodeId zx = m.cell(2), zy = m.cell(3);
    const NodeId size = m.make(Op::add, {m.make(Op::square, {zx}), m.make(Op::square, {zy})});
    const NodeId go_on = m.make(Op::logical_and, {m.make(Op::less, {size, m.number(4.0)}),
                                                  m.make(Op::less, {m.cell(4), m.number(most)})});
    const NodeId next_x =
        m.make(Op::add, {m.make(Op::sub, {m.make(Op::square, {zx}), m.make(Op::square, {zy})}), m.cell(0)});
    const NodeId product = m.make(Op::mul, {zx, zy});
    const NodeId next_y = m.make(Op::add, {m.make(Op::add, {product, product}), m.cell(1)});
    const auto step = m.assign({{2, next_x}, {3, next_y}, {4, m.make(Op::add, {m.cell(4), m.number(1.0)})}});
    const auto start = m.assign({{2, m.number(0.0)}, {3, m.number(0.0)}, {4, m.number(0.0)}});
    m.region->program = {start, m.loop(go_on, {step})};
    return m;
}

}  // namespace frep_test
