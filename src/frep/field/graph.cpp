#include "frep/field/graph.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "frep/base/result.h"
#include "frep/field/copy.h"
#include "frep/field/field.h"
#include "frep/field/meaning.h"
#include "frep/field/region.h"

namespace frep {
namespace {

constexpr NodeId no_node = std::numeric_limits<NodeId>::max();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t first_slots = 64;
/// Operands of an operation that are held without a heap.
constexpr std::size_t few = 8;

std::uint64_t mix(std::uint64_t h, std::uint64_t value) {
    h ^= value + 0x9E3779B97F4A7C15u + (h << 6) + (h >> 2);
    return h * 0xD6E8FEB86659FD93u;
}

bool is_commutative(Op op) {
    switch (op) {
        case Op::add:
        case Op::mul:
        case Op::min:
        case Op::max:
        case Op::hypot:
        case Op::r_and:
        case Op::r_or:
        case Op::logical_and:
        case Op::logical_or:
        case Op::equal:
            return true;
        default:
            return false;
    }
}

bool is_truth_value(Op op) {
    switch (op) {
        case Op::truth:
        case Op::logical_not:
        case Op::logical_and:
        case Op::logical_or:
        case Op::less:
        case Op::less_equal:
        case Op::equal:
            return true;
        default:
            return false;
    }
}

/// Bits of a number; all NaNs are one.
std::uint64_t bits_of(double value) {
    return std::bit_cast<std::uint64_t>(value != value ? not_a_number : value);
}

}  // namespace

Graph::Graph() = default;
Graph::~Graph() = default;
Graph::Graph(Graph&&) noexcept = default;
Graph& Graph::operator=(Graph&&) noexcept = default;

std::size_t Graph::hash(Op op, std::span<const NodeId> arguments, std::uint32_t payload) const {
    std::uint64_t h =
        mix(static_cast<std::uint64_t>(op), op == Op::constant ? bits_of(constants_[payload]) : payload);
    for (NodeId id : arguments) h = mix(h, id);
    return static_cast<std::size_t>(h ^ (h >> 32));
}

bool Graph::same(NodeId id, Op op, std::span<const NodeId> args, std::uint32_t payload) const {
    const Node& n = nodes_[id];
    if (n.op != op || n.argument_count != args.size()) return false;
    if (op == Op::constant) return bits_of(constants_[n.payload]) == bits_of(constants_[payload]);
    return n.payload == payload &&
           std::equal(args.begin(), args.end(), arguments_.begin() + n.first_argument);
}

void Graph::build_table(std::size_t slots) {
    table_.assign(slots, no_node);
    const std::size_t mask = slots - 1;
    for (NodeId id = 0; id < nodes_.size(); ++id) {
        std::size_t slot = hash(nodes_[id].op, arguments(id), nodes_[id].payload) & mask;
        while (table_[slot] != no_node) slot = (slot + 1) & mask;
        table_[slot] = id;
    }
}

void Graph::reserve(std::size_t nodes) {
    nodes = std::min(nodes, node_limit);
    nodes_.reserve(nodes);
    arguments_.reserve(2 * nodes);
    flags_.reserve(nodes);
    origins_.reserve(nodes);
    if (table_.size() < 2 * nodes) build_table(std::bit_ceil(2 * nodes));
}

double Graph::known_value(NodeId id) const {
    if (nodes_[id].op == Op::constant) return constant_of(id);
    return id < bound_.size() ? bound_[id] : not_a_number;
}

void Graph::know(NodeId id, double value) {
    if (bound_.size() <= id) bound_.resize(std::size_t{id} + 1, not_a_number);
    bound_[id] = value;
}

NodeId Graph::append(Op op, std::span<const NodeId> args, std::uint32_t payload, std::uint8_t flags) {
    const auto id = static_cast<NodeId>(nodes_.size());
    const auto first = static_cast<std::uint32_t>(arguments_.size());
    nodes_.push_back({op, payload, first, static_cast<std::uint32_t>(args.size())});
    for (const NodeId argument : args) arguments_.push_back(argument);
    flags_.push_back(flags);
    origins_.push_back(origin_);
    return id;
}

NodeId Graph::insert(Op op, std::span<const NodeId> args, std::uint32_t payload, std::uint8_t flags) {
    if (table_.size() < 2 * nodes_.size() + 2) build_table(std::bit_ceil(4 * nodes_.size() + first_slots));
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = hash(op, args, payload) & mask;
    for (; table_[slot] != no_node; slot = (slot + 1) & mask)
        if (same(table_[slot], op, args, payload)) return table_[slot];
    if (nodes_.size() >= node_limit) {
        over_limit_ = true;
        return 0;
    }
    return table_[slot] = append(op, args, payload, flags);
}

NodeId Graph::constant(double value) {
    constants_.push_back(value);
    const auto payload = static_cast<std::uint32_t>(constants_.size() - 1);
    const std::size_t before = nodes_.size();
    const NodeId id = insert(Op::constant, {}, payload, 0);
    if (nodes_.size() == before) constants_.pop_back();
    return id;
}

NodeId Graph::coordinate(int index) {
    return insert(Op::coordinate, {}, static_cast<std::uint32_t>(index), point_flag);
}

NodeId Graph::parameter(int index) {
    const NodeId id = insert(Op::parameter, {}, static_cast<std::uint32_t>(index), parameter_flag);
    const auto i = static_cast<std::size_t>(index);
    if (!over_limit_) know(id, i < parameters_.size() ? parameters_[i] : 0.0);
    return id;
}

NodeId Graph::undefined() {
    // The payload makes the node unlike every other, so that each keeps its own place in the text.
    return insert(Op::undefined, {}, static_cast<std::uint32_t>(nodes_.size()), 0);
}

std::span<const double> Graph::block_of(NodeId id) const {
    const Node& n = nodes_[id];
    if (info(n.op).kind != OpKind::block || n.payload == 0) return {};
    return *blocks_[n.payload - 1];
}

double Graph::evaluate(Op op, std::span<const NodeId> args, std::uint32_t payload) const {
    std::array<double, few> direct;
    std::vector<double> many(args.size() > few ? args.size() : 0);
    const std::span<double> values =
        args.size() > few ? std::span(many) : std::span(direct).first(args.size());
    for (std::size_t i = 0; i < args.size(); ++i) values[i] = known_value(args[i]);
    std::span<const double> block;
    if (info(op).kind == OpKind::block && payload) block = *blocks_[payload - 1];
    return meaning<double>(op, std::span<const double>(values), block);
}

std::optional<NodeId> Graph::simplified(Op op, std::span<const NodeId> args, std::uint32_t payload) {
    auto op_of = [&](NodeId id) { return nodes_[id].op; };
    auto is = [&](NodeId id, double value) {
        return op_of(id) == Op::constant && bits_of(constant_of(id)) == bits_of(value);
    };
    switch (op) {
        case Op::neg:
            if (op_of(args[0]) == Op::neg) return arguments(args[0])[0];
            break;
        case Op::add:
            if (is(args[1], -0.0)) return args[0];
            if (op_of(args[1]) == Op::neg) return make(Op::sub, {args[0], arguments(args[1])[0]});
            if (op_of(args[0]) == Op::neg) return make(Op::sub, {args[1], arguments(args[0])[0]});
            break;
        case Op::sub:
            if (is(args[1], 0.0)) return args[0];
            if (op_of(args[1]) == Op::neg) return make(Op::add, {args[0], arguments(args[1])[0]});
            break;
        case Op::mul:
            if (args[0] == args[1]) return make(Op::square, {args[0]});
            if (is(args[0], 1.0)) return args[1];
            if (is(args[1], 1.0)) return args[0];
            break;
        case Op::div:
            if (is(args[1], 1.0)) return args[0];
            break;
        case Op::min:
        case Op::max:
            if (args[0] == args[1]) return args[0];
            break;
        case Op::truth:
            if (is_truth_value(op_of(args[0]))) return args[0];
            break;
        case Op::select:
            if (const auto condition = constant_value(args[0]); condition && *condition == *condition)
                return meaning<double>(Op::truth, std::array{*condition}, {}) != 0 ? args[1] : args[2];
            break;
        default:
            break;
    }
    static_cast<void>(payload);
    return std::nullopt;
}

NodeId Graph::make(Op op, std::span<const NodeId> given, std::uint32_t payload) {
    FREP_CHECK(info(op).kind != OpKind::plain || static_cast<int>(given.size()) == info(op).arity);
    if (over_limit_) return 0;
    std::array<NodeId, 2> sorted;
    std::span<const NodeId> args = given;
    if (is_commutative(op) && given[1] < given[0]) {
        sorted = {given[1], given[0]};
        args = sorted;
    }
    std::uint8_t flags = 0;
    for (NodeId id : args) flags |= flags_[id];
    if (op == Op::cell || op == Op::load || op == Op::region || op == Op::output) flags |= point_flag;
    if (info(op).kind != OpKind::leaf) {
        if (const auto simpler = simplified(op, args, payload)) return *simpler;
        if (flags == 0) {
            const double value = evaluate(op, args, payload);
            if (value == value) return constant(value);
        }
    }
    // The arguments may lie in the arena itself, which insert() may move.
    std::array<NodeId, few> direct;
    std::vector<NodeId> many;
    if (args.size() > few) {
        many.assign(args.begin(), args.end());
        args = many;
    } else {
        std::copy(args.begin(), args.end(), direct.begin());
        args = std::span(direct).first(args.size());
    }
    const std::size_t before = nodes_.size();
    const NodeId id = insert(op, args, payload, flags);
    if (nodes_.size() > before && !(flags & point_flag) && info(op).kind != OpKind::leaf)
        know(id, evaluate(op, args, payload));
    return id;
}

std::uint32_t Graph::intern_block(Block values) {
    std::uint64_t key = values->size();
    for (double value : *values) key = mix(key, bits_of(value));
    const auto [first, last] = block_index_.equal_range(key);
    for (auto i = first; i != last; ++i) {
        const Block& known = blocks_[i->second];
        const bool equal =
            known == values || std::equal(values->begin(), values->end(), known->begin(), known->end(),
                                          [](double x, double y) { return bits_of(x) == bits_of(y); });
        if (equal) return i->second + 1;
    }
    block_index_.emplace(key, static_cast<std::uint32_t>(blocks_.size()));
    blocks_.push_back(std::move(values));
    return static_cast<std::uint32_t>(blocks_.size());
}

NodeId Graph::make_block(Op op, std::span<const NodeId> lead, std::vector<double> data) {
    FREP_CHECK(info(op).kind == OpKind::block && static_cast<int>(lead.size()) == info(op).arity);
    FREP_CHECK(!data.empty());
    return make(op, lead, intern_block(std::make_shared<const std::vector<double>>(std::move(data))));
}

NodeId Graph::make_block(Op op, std::span<const NodeId> lead, std::span<const NodeId> data) {
    FREP_CHECK(info(op).kind == OpKind::block && static_cast<int>(lead.size()) == info(op).arity);
    const bool constant_data = !data.empty() && std::all_of(data.begin(), data.end(), [&](NodeId id) {
        return nodes_[id].op == Op::constant;
    });
    if (constant_data) {
        std::vector<double> values(data.size());
        std::transform(data.begin(), data.end(), values.begin(), [&](NodeId id) { return constant_of(id); });
        return make_block(op, lead, std::move(values));
    }
    std::vector<NodeId> all(lead.begin(), lead.end());
    all.insert(all.end(), data.begin(), data.end());
    return make(op, all);
}

NodeId Graph::make_region(std::shared_ptr<const Region> region, std::span<const NodeId> args) {
    FREP_CHECK(args.size() == region->inputs.size() + 1);
    regions_.push_back(std::move(region));
    return make(Op::region, args, static_cast<std::uint32_t>(regions_.size() - 1));
}

std::optional<double> Graph::constant_value(NodeId id) const {
    if (flags_[id] != 0) return std::nullopt;
    return known_value(id);
}

std::optional<double> Graph::bound_value(NodeId id) const {
    if (flags_[id] & point_flag) return std::nullopt;
    return known_value(id);
}

void Graph::truncate(std::size_t size) {
    if (size >= nodes_.size()) return;
    arguments_.resize(nodes_[size].first_argument);
    nodes_.resize(size);
    flags_.resize(size);
    origins_.resize(size);
    bound_.resize(std::min(size, bound_.size()));
    table_.clear();
    over_limit_ = false;
}

std::vector<bool> reachable(const Graph& graph, std::span<const NodeId> roots) {
    std::vector<bool> needed(graph.size(), false);
    for (NodeId root : roots) needed[root] = true;
    for (std::size_t i = graph.size(); i-- > 0;)
        if (needed[i])
            for (NodeId argument : graph.arguments(static_cast<NodeId>(i))) needed[argument] = true;
    return needed;
}

Graph compact(const Graph& graph, std::span<NodeId> roots) {
    const std::vector<bool> needed = reachable(graph, roots);
    std::vector<NodeId> renamed(graph.size(), 0);
    Graph out = graph.copy_of(needed, renamed);
    for (NodeId& root : roots) root = renamed[root];
    return out;
}

Graph Graph::copy_of(const std::vector<bool>& needed, std::span<NodeId> renamed) const {
    Graph out;
    out.parameters_ = parameters_;
    std::vector<std::uint32_t> block_names(blocks_.size(), 0);
    std::vector<NodeId> args;
    for (NodeId id = 0; id < nodes_.size(); ++id) {
        if (!needed[id]) continue;
        const Node& n = nodes_[id];
        args.clear();
        for (const NodeId argument : arguments(id)) args.push_back(renamed[argument]);
        std::uint32_t payload = n.payload;
        if (n.op == Op::constant) {
            out.constants_.push_back(constants_[payload]);
            payload = static_cast<std::uint32_t>(out.constants_.size() - 1);
        } else if (n.op == Op::region) {
            out.regions_.push_back(regions_[payload]);
            payload = static_cast<std::uint32_t>(out.regions_.size() - 1);
        } else if (info(n.op).kind == OpKind::block && payload) {
            std::uint32_t& name = block_names[payload - 1];
            if (!name) {
                name = out.intern_block(blocks_[payload - 1]);
            }
            payload = name;
        }
        out.origin_ = origins_[id];
        renamed[id] = out.append(n.op, args, payload, flags_[id]);  // equal nodes were one before
        if (!depends_on_point(id) && n.op != Op::constant) out.know(renamed[id], known_value(id));
    }
    return out;
}

NodeId Graph::make_as(const Graph& from, NodeId id, std::span<const NodeId> args,
                      std::vector<std::uint32_t>& block_names) {
    const Node& n = from.nodes_[id];
    switch (n.op) {
        case Op::constant:
            return constant(from.constants_[n.payload]);
        case Op::parameter:
            return parameter(static_cast<int>(n.payload));
        case Op::coordinate:
            return coordinate(static_cast<int>(n.payload));
        case Op::undefined:
            return undefined();
        case Op::region:
            return make_region(from.regions_[n.payload], args);
        default:
            break;
    }
    if (info(n.op).kind != OpKind::block) return make(n.op, args, n.payload);
    if (n.payload) {
        block_names.resize(from.blocks_.size(), 0);
        std::uint32_t& name = block_names[n.payload - 1];
        if (!name) name = intern_block(from.blocks_[n.payload - 1]);
        return make(n.op, args, name);
    }
    const auto lead = static_cast<std::size_t>(info(n.op).arity);
    return make_block(n.op, args.first(lead), args.subspan(lead));
}

Graph Graph::bound_copy(const std::vector<bool>& needed, std::span<const double> parameters,
                        std::span<NodeId> renamed) const {
    Graph out;
    copy_nodes(out, *this, needed, renamed, [&](NodeId id, std::span<const NodeId>) {
        return nodes_[id].op == Op::parameter ? std::optional(out.constant(parameters[nodes_[id].payload]))
                                              : std::nullopt;
    });
    return out;
}

OperationCount count_operations(const Graph& graph, std::span<const NodeId> roots) {
    const std::vector<bool> needed = reachable(graph, roots);
    OperationCount count;
    for (NodeId id = 0; id < graph.size(); ++id) {
        const OpInfo& row = info(graph.node(id).op);
        if (!needed[id] || row.kind == OpKind::leaf) continue;
        ++count.operations;
        count.cost += static_cast<std::size_t>(row.cost);
        if (row.kind == OpKind::block) {
            const std::size_t items = graph.arguments(id).size() - static_cast<std::size_t>(row.arity);
            count.cost += static_cast<std::size_t>(row.cost) * std::max(items, graph.block_of(id).size());
        }
    }
    return count;
}

Field bind_parameters(const Field& field) {
    std::vector<NodeId> roots = field.roots();
    const std::vector<bool> needed = reachable(*field.graph, roots);
    bool uses_parameters = false;
    for (NodeId id = 0; id < needed.size() && !uses_parameters; ++id)
        uses_parameters = needed[id] && field.graph->node(id).op == Op::parameter;
    if (!uses_parameters) return field;
    std::vector<NodeId> renamed(field.graph->size());
    Field out = field;
    out.graph = std::make_shared<const Graph>(field.graph->bound_copy(needed, field.parameters, renamed));
    out.value = renamed[field.value];
    for (NodeId& attribute : out.attributes) attribute = renamed[attribute];
    return out;
}

bool has_regions(const Field& field) {
    const std::vector<NodeId> roots = field.roots();
    const std::vector<bool> needed = reachable(*field.graph, roots);
    for (NodeId id = 0; id < field.graph->size(); ++id)
        if (needed[id] && field.graph->node(id).op == Op::region) return true;
    return false;
}

}  // namespace frep
