// Random fields for tests of the engines: every operation of the table, with data blocks and regions, from a
// seed. The same seed gives the same field on every machine.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "frep/field/field.h"
#include "frep/math/bits.h"
#include "frep/shapes/area.h"

namespace frep_test {

/// Counter-based random numbers (splitmix64).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 0x1234567u) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    /// 0 .. n - 1.
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }
    bool chance(int percent) { return below(100) < static_cast<std::size_t>(percent); }
    double real(double low, double high) {
        return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    }
    /// A short decimal number, as models have them.
    double plain(double size) { return static_cast<double>(static_cast<int>(real(-size, size) * 8)) / 8; }

  private:
    std::uint64_t state_;
};

/// Numbers at which operations have their edges.
inline constexpr std::array<double, 36> special_numbers = {frep::math::quiet_nan,
                                                           frep::math::infinity,
                                                           -frep::math::infinity,
                                                           0.0,
                                                           -0.0,
                                                           0x1p-1074,
                                                           -0x1p-1074,
                                                           0x1p-1022,
                                                           -0x1.8p-1030,
                                                           1e-300,
                                                           -1e-300,
                                                           1e-160,
                                                           1e160,
                                                           -1e160,
                                                           1e300,
                                                           -1e300,
                                                           0x1.fffffffffffffp1023,
                                                           -0x1.fffffffffffffp1023,
                                                           1e-6,
                                                           0x1.0c6f7a0b5ed8cp-20,
                                                           0x1.0c6f7a0b5ed8ep-20,
                                                           -1e-6,
                                                           1e-7,
                                                           1.0,
                                                           -1.0,
                                                           0x1.fffffffffffffp-1,
                                                           0x1.0000000000001p0,
                                                           0.5,
                                                           -0.5,
                                                           1.5,
                                                           2.0,
                                                           3.0,
                                                           -2.0,
                                                           3.14159265358979312,
                                                           -7.25,
                                                           1000.5};

/// How the data of a block operation are laid out, read off its line in the table ("data x0 y0 z0 a b",
/// "data begin(3) end(3) S"): numbers of one item; volume = "l m n, then l*m*n values".
struct DataLayout {
    std::size_t item = 1;
    bool volume = false;
    std::size_t least = 1;  ///< values an axis at least; fewer leave the volume undefined
};

inline DataLayout data_layout(frep::Op op) {
    const std::string_view doc = frep::info(op).doc;
    const std::size_t at = doc.find("data ");
    if (at == std::string_view::npos) return {};
    if (doc.find(", then") != std::string_view::npos)
        return {3, true, op == frep::Op::bspline_volume ? 4u : op == frep::Op::voxels ? 2u : 1u};
    DataLayout layout{0, false};
    bool in_word = false;
    for (std::size_t i = at + 5; i < doc.size() && doc[i] != ';' && doc[i] != ','; ++i) {
        if (doc[i] == '(') {
            layout.item += static_cast<std::size_t>(doc[i + 1] - '0') - 1;
            i += 2;
        } else if (doc[i] == ' ') {
            in_word = false;
        } else if (!in_word) {
            in_word = true;
            ++layout.item;
        }
    }
    return layout;
}

/// Data of outline_distance, which are no free numbers: of a few contours that cross themselves and one
/// another.
inline std::vector<double> outline_data(Random& random) {
    for (;;) {
        frep::Area area;
        for (std::size_t part = 1 + random.below(3); part > 0; --part) {
            std::vector<frep::Vec2> contour(3 + random.below(6));
            for (frep::Vec2& p : contour) p = {random.plain(3), random.plain(3)};
            const auto rule = random.chance(50) ? frep::FillRule::nonzero : frep::FillRule::even_odd;
            area.parts.push_back({{contour}, rule});
        }
        if (auto data = frep::shapes::area_data(area)) return *data;  // else: without area
    }
}

struct RandomOptions {
    int operations = 25;
    int coordinates = 3;
    int parameters = 2;
    int attributes = 1;
    int region_percent = 4;  ///< share of operations that are regions
};

/// Makes one random field. Every operation of the table can come.
class RandomField {
  public:
    explicit RandomField(std::uint64_t seed, RandomOptions options = {}) : random_(seed), options_(options) {}

    frep::Field make();

  private:
    using NodeId = frep::NodeId;

    NodeId leaf(frep::Graph& graph, std::vector<NodeId>& pool);
    NodeId operand(const std::vector<NodeId>& pool);
    NodeId operation(frep::Graph& graph, const std::vector<NodeId>& pool);
    NodeId block(frep::Graph& graph, frep::Op op, const std::vector<NodeId>& pool);
    NodeId item(frep::Graph& graph, const std::vector<NodeId>& pool, bool constant);
    void region(frep::Graph& graph, std::vector<NodeId>& pool);
    frep::Op any_operation();

    Random random_;
    RandomOptions options_;
};

/// A region with loops, branches and stores on its own. Some of its loops never end.
class RandomRegion {
  public:
    RandomRegion(Random& random) : random_(random) {}
    std::shared_ptr<const frep::Region> make();
    /// Makes an operation of the body on nodes of `pool`; set by RandomField.
    std::function<frep::NodeId(frep::Graph&, const std::vector<frep::NodeId>&)> operation;

  private:
    std::vector<std::uint32_t> statements(int depth);
    std::uint32_t statement(int depth);
    frep::NodeId expression(int operations);
    std::uint32_t cell() { return static_cast<std::uint32_t>(random_.below(scalars_)); }

    Random& random_;
    std::shared_ptr<frep::Region> region_;
    std::size_t scalars_ = 0;
};

inline frep::NodeId RandomRegion::expression(int operations) {
    frep::Graph& body = region_->body;
    std::vector<frep::NodeId> pool;
    for (int i = 0; i < 3; ++i) pool.push_back(body.make(frep::Op::cell, {}, cell()));
    pool.push_back(body.constant(random_.plain(3)));
    if (!region_->arrays.empty() && random_.chance(40)) {
        const auto array = static_cast<std::uint32_t>(random_.below(region_->arrays.size()));
        pool.push_back(body.make(frep::Op::load, {pool[random_.below(pool.size())]}, array));
    }
    if (random_.chance(1)) pool.push_back(body.undefined());
    for (int i = 0; i < operations; ++i) pool.push_back(operation(body, pool));
    return pool.back();
}

inline std::uint32_t RandomRegion::statement(int depth) {
    using Kind = frep::RegionStatement::Kind;
    frep::Graph& body = region_->body;
    frep::RegionStatement s;
    const std::size_t kind = random_.below(depth > 0 ? 8 : 5);
    if (kind < 4 || (kind == 4 && region_->arrays.empty())) {
        s.kind = Kind::assign;
        for (std::size_t i = 1 + random_.below(2); i-- > 0;)
            s.assignments.emplace_back(cell(), expression(static_cast<int>(random_.below(3))));
        if (random_.chance(15)) {  // two cells change places
            const std::uint32_t a = cell(), b = cell();
            s.assignments = {{a, body.make(frep::Op::cell, {}, b)}, {b, body.make(frep::Op::cell, {}, a)}};
        }
    } else if (kind == 4) {
        s.kind = Kind::store;
        s.array = static_cast<std::uint32_t>(random_.below(region_->arrays.size()));
        s.index =
            random_.chance(60) ? body.constant(static_cast<double>(random_.below(4)) + 1) : expression(1);
        s.value = expression(1);
    } else if (kind < 7) {
        s.kind = Kind::branch;
        s.condition = expression(2);
        s.first = statements(depth - 1);
        s.second = statements(depth - 1);
    } else {
        // cell 0 counts; loops whose body resets it may never end
        s.kind = Kind::loop;
        const frep::NodeId count = body.make(frep::Op::cell, {}, 0);
        s.condition = body.make(frep::Op::less, {count, body.constant(random_.real(0, 6))});
        if (random_.chance(30)) s.condition = body.make(frep::Op::logical_and, {s.condition, expression(2)});
        s.first = statements(depth - 1);
        frep::RegionStatement step;
        step.assignments = {{0u, body.make(frep::Op::add, {count, body.constant(1.0)})}};
        region_->statements.push_back(step);
        s.first.push_back(static_cast<std::uint32_t>(region_->statements.size() - 1));
    }
    region_->statements.push_back(s);
    return static_cast<std::uint32_t>(region_->statements.size() - 1);
}

inline std::vector<std::uint32_t> RandomRegion::statements(int depth) {
    std::vector<std::uint32_t> list;
    for (std::size_t i = random_.below(4); i-- > 0;) list.push_back(statement(depth));
    return list;
}

inline std::shared_ptr<const frep::Region> RandomRegion::make() {
    region_ = std::make_shared<frep::Region>();
    scalars_ = 2 + random_.below(4);
    region_->cell_count = static_cast<std::uint32_t>(scalars_);
    for (std::size_t i = random_.below(3); i-- > 0;) {
        const auto size = static_cast<std::uint32_t>(1 + random_.below(5));
        region_->arrays.push_back({region_->cell_count, size});
        region_->cell_count += size;
    }
    region_->inputs = {0};
    for (std::uint32_t i = 1; i < region_->cell_count; ++i)
        if (random_.chance(80)) region_->inputs.push_back(i);
    region_->program = statements(3);
    region_->program.push_back(statement(3));
    return region_;
}

inline frep::NodeId RandomField::leaf(frep::Graph& graph, std::vector<NodeId>& pool) {
    const std::size_t kind = random_.below(10);
    if (kind < 5 && options_.coordinates > 0)
        return graph.coordinate(
            static_cast<int>(random_.below(static_cast<std::size_t>(options_.coordinates))));
    if (kind == 5 && options_.parameters > 0)
        return graph.parameter(
            static_cast<int>(random_.below(static_cast<std::size_t>(options_.parameters))));
    if (kind == 6 && random_.chance(4)) return graph.undefined();
    if (kind == 7 && random_.chance(15)) return graph.constant(special_numbers[random_.below(36)]);
    static_cast<void>(pool);
    return graph.constant(random_.plain(4));
}

/// Late nodes are likelier, so that graphs become deep as well as wide.
inline frep::NodeId RandomField::operand(const std::vector<NodeId>& pool) {
    const std::size_t a = random_.below(pool.size()), b = random_.below(pool.size());
    return pool[random_.chance(60) ? std::max(a, b) : a];
}

inline frep::Op RandomField::any_operation() {
    for (;;) {
        const auto op = static_cast<frep::Op>(random_.below(frep::op_count));
        if (frep::info(op).kind == frep::OpKind::leaf) continue;
        // Half of the operations are cheap ones that are mostly defined.
        if (random_.chance(50) && frep::info(op).cost > 5) continue;
        return op;
    }
}

inline frep::NodeId RandomField::item(frep::Graph& graph, const std::vector<NodeId>& pool, bool constant) {
    return constant || random_.chance(60) ? graph.constant(random_.plain(3)) : operand(pool);
}

inline frep::NodeId RandomField::block(frep::Graph& graph, frep::Op op, const std::vector<NodeId>& pool) {
    std::vector<NodeId> lead, data;
    for (int i = 0; i < frep::info(op).arity; ++i) lead.push_back(operand(pool));
    const bool constant = random_.chance(70);
    if (op == frep::Op::outline_distance && constant)
        return graph.make_block(op, lead, outline_data(random_));
    const DataLayout layout = data_layout(op);
    std::size_t items = layout.item * (1 + random_.below(4));
    if (layout.volume) {
        items = 1;
        for (int i = 0; i < 3; ++i) {
            const std::size_t n = random_.chance(4) ? 1 : layout.least + random_.below(3);
            items *= n;
            data.push_back(graph.constant(static_cast<double>(n)));
        }
    }
    for (std::size_t i = 0; i < items; ++i) data.push_back(item(graph, pool, constant));
    return graph.make_block(op, lead, data);
}

inline frep::NodeId RandomField::operation(frep::Graph& graph, const std::vector<NodeId>& pool) {
    const frep::Op op = any_operation();
    if (frep::info(op).kind == frep::OpKind::block) return block(graph, op, pool);
    std::vector<NodeId> arguments;
    for (int i = 0; i < frep::info(op).arity; ++i) arguments.push_back(operand(pool));
    return graph.make(op, arguments);
}

inline void RandomField::region(frep::Graph& graph, std::vector<NodeId>& pool) {
    RandomRegion maker(random_);
    maker.operation = [this](frep::Graph& body, const std::vector<NodeId>& nodes) {
        return operation(body, nodes);
    };
    const auto made = maker.make();
    std::vector<NodeId> arguments = {random_.chance(60) ? graph.constant(1.0) : operand(pool)};
    arguments.push_back(random_.chance(60) ? graph.constant(0.0) : operand(pool));
    while (arguments.size() < made->inputs.size() + 1) arguments.push_back(operand(pool));
    const NodeId id = graph.make_region(made, arguments);
    for (std::size_t i = 1 + random_.below(3); i-- > 0;)
        pool.push_back(
            graph.make(frep::Op::output, {id}, static_cast<std::uint32_t>(random_.below(made->cell_count))));
}

inline frep::Field RandomField::make() {
    auto graph = std::make_shared<frep::Graph>();
    frep::Field field;
    field.coordinates = options_.coordinates;
    for (int i = 0; i < options_.parameters; ++i) field.parameters.push_back(random_.plain(2));
    graph->set_parameters(field.parameters);
    std::vector<NodeId> pool;
    for (int i = 0; i < options_.coordinates; ++i) pool.push_back(graph->coordinate(i));
    for (int i = 0; i < 4; ++i) pool.push_back(leaf(*graph, pool));
    for (int i = 0; i < options_.operations; ++i) {
        if (random_.chance(15)) pool.push_back(leaf(*graph, pool));
        if (random_.chance(options_.region_percent))
            region(*graph, pool);
        else
            pool.push_back(operation(*graph, pool));
    }
    field.value = pool.back();
    for (int i = 0; i < options_.attributes; ++i) field.attributes.push_back(operand(pool));
    field.graph = std::move(graph);
    return field;
}

/// A coordinate for tests: mostly ordinary, sometimes at an edge.
inline double random_coordinate(Random& random) {
    if (random.chance(5)) return special_numbers[random.below(special_numbers.size())];
    return random.chance(30) ? random.plain(3) : random.real(-3, 3);
}

}  // namespace frep_test
