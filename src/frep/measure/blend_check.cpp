// Implementation of blend_check.h.
#include "frep/measure/blend_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "frep/base/parallel.h"

namespace frep {

namespace {

using math::Interval;
using Index = std::array<std::uint32_t, 3>;

/// The box has 2^levels cells along its longest side, unless they become too many.
constexpr int levels = 7;
constexpr std::size_t most_cells = 40'000;
/// Samples along a side of the smallest cells.
constexpr std::uint32_t samples_a_side = 4;
/// Samples no farther apart than this many steps belong together.
constexpr int reach = 2;
/// Parts with less than this share of the samples of the largest are ragged ends of it.
constexpr double smallest_part = 0.02;
constexpr std::size_t fewest_samples = 8;
constexpr std::size_t most_findings = 4;

bool is_bounded(Op op) { return op == Op::bounded_uni || op == Op::bounded_int; }
bool is_by_points(Op op) { return op == Op::point_uni || op == Op::point_int; }
bool is_blend(Op op) {
    return is_bounded(op) || is_by_points(op) || op == Op::blend_uni || op == Op::blend_int;
}
bool is_union(Op op) { return op == Op::blend_uni || op == Op::bounded_uni || op == Op::point_uni; }

Field as_field(Graph graph, NodeId root) {
    Field out;
    out.value = root;
    out.coordinates = 3;
    NodeId renamed = root;
    out.graph = std::make_shared<const Graph>(compact(graph, {&renamed, 1}));
    out.value = renamed;
    return out;
}

/// The functions that are compared for one blend.
struct BlendFields {
    Field plain;     ///< the model with the plain set operation in place of the blend
    Field activity;  ///< > 0 where the blend may displace
    Field first, second;
};

Graph copy_of_all(const Graph& graph, std::vector<NodeId>& renamed) {
    renamed.assign(graph.size(), 0);
    return graph.copy_of(std::vector<bool>(graph.size(), true), renamed);
}

BlendFields fields_of(const Field& field, NodeId blend) {
    const Graph& from = *field.graph;
    const Op op = from.node(blend).op;
    BlendFields out;
    // the nodes keep their meaning, but for the blend
    Graph to;
    std::vector<NodeId> made(from.size(), 0), arguments;
    std::vector<std::uint32_t> block_names;
    for (NodeId id = 0; id < from.size(); ++id) {
        arguments.clear();
        for (const NodeId argument : from.arguments(id)) arguments.push_back(made[argument]);
        const Node& node = from.node(id);
        if (id == blend)
            made[id] = to.make(is_union(op) ? Op::r_or : Op::r_and, {arguments[0], arguments[1]});
        else if (node.op == Op::coordinate)
            made[id] = to.coordinate(static_cast<int>(node.payload));
        else
            made[id] = to.make_as(from, id, arguments, block_names);
    }
    out.plain = as_field(std::move(to), made[field.value]);

    const auto operand = [&](std::size_t k) {
        std::vector<NodeId> renamed;
        Graph graph = copy_of_all(from, renamed);
        return as_field(std::move(graph), renamed[from.arguments(blend)[k]]);
    };
    out.first = operand(0);
    out.second = operand(1);
    if (is_bounded(op)) {
        out.activity = operand(2);
        return out;
    }
    std::vector<NodeId> renamed;
    Graph graph = copy_of_all(from, renamed);
    NodeId active = graph.constant(1);
    if (is_by_points(op)) {
        const auto share = [&](std::size_t f, std::size_t a) {
            const NodeId over =
                graph.make(Op::div, {renamed[from.arguments(blend)[f]], renamed[from.arguments(blend)[a]]});
            return graph.make(Op::square, {over});
        };
        active = graph.make(Op::sub, {active, graph.make(Op::add, {share(0, 3), share(1, 4)})});
    }
    out.activity = as_field(std::move(graph), active);
    return out;
}

/// A blend that cannot displace anything has an amount or an extent of 0: that is meant.
bool is_off(const Field& field, NodeId blend) {
    const auto arguments = field.graph->arguments(blend);
    for (std::size_t k = is_bounded(field.graph->node(blend).op) ? 3 : 2; k < arguments.size(); ++k) {
        const auto value = field.graph->constant_value(arguments[k]);
        if (value && *value == 0) return true;
    }
    return false;
}

/// A place where the shape with the blend is not the shape without.
struct Change {
    Index sample{};
    Vec3 place;
    double amount = 0;  ///< how far the two functions are apart
};

class BlendSearch {
  public:
    BlendSearch(const Field& field, const BlendCheckOptions& options, std::vector<std::size_t> axes,
                const Job& job)
        : field_(field), options_(options), axes_(std::move(axes)), job_(job) {
        const Box3& b = options.bounds;
        low_ = {b.min.x, b.min.y, b.min.z};
        const std::array<double, 3> high{b.max.x, b.max.y, b.max.z};
        double longest = 0;
        for (const std::size_t axis : axes_) longest = std::max(longest, high[axis] - low_[axis]);
        step_ = longest / (1u << levels);
        for (std::size_t axis = 0; axis < 3; ++axis) low_[axis] = options.axes[axis] ? low_[axis] : 0;
        for (const std::size_t axis : axes_)
            cells_[axis] = static_cast<std::uint32_t>(std::ceil((high[axis] - low_[axis]) / step_));
    }

    /// What is wrong with the blend at node `blend`.
    std::vector<BlendFinding> findings(NodeId blend) {
        BlendFinding finding;
        finding.node = blend;
        finding.op = field_.graph->node(blend).op;
        finding.origin = field_.graph->origin(blend);
        const BlendFields fields = fields_of(field_, blend);
        auto whole = make_evaluator(field_, options_.evaluator),
             plain = make_evaluator(fields.plain, options_.evaluator);
        auto activity = make_evaluator(fields.activity, options_.evaluator);
        auto first = make_evaluator(fields.first, options_.evaluator);
        auto second = make_evaluator(fields.second, options_.evaluator);
        if (!whole || !plain || !activity || !first || !second) return {};
        int level = levels;
        const std::vector<Index> cells = open_cells(**activity, **whole, **plain, level);
        if (job_.cancelled()) return {};
        if (cells.empty()) return {finding};
        const std::vector<Change> changes = changes_in(cells, level, **whole, **plain);
        const std::vector<std::vector<std::size_t>> parts = connected_parts(changes);
        if (parts.size() < 2) return {};
        std::vector<bool> is_unexpected(parts.size(), false);
        if (is_by_points(finding.op)) {
            finding.flaw = BlendFlaw::second_place;
            std::fill(is_unexpected.begin() + 1, is_unexpected.end(), true);
        } else if (is_bounded(finding.op)) {
            finding.flaw = BlendFlaw::through_wall;
            bool any_joint = false;
            for (std::size_t p = 0; p < parts.size(); ++p) {
                const bool joint = touches_joint(parts[p], changes, level, **first, **second);
                is_unexpected[p] = !joint;
                any_joint = any_joint || joint;
            }
            if (!any_joint) return {};
        }
        const auto most = [&](const std::vector<std::size_t>& part) {
            return changes[*std::max_element(part.begin(), part.end(),
                                             [&](std::size_t a, std::size_t b) {
                                                 return changes[a].amount < changes[b].amount;
                                             })]
                .place;
        };
        std::vector<BlendFinding> out;
        for (std::size_t p = 0; p < parts.size() && out.size() < most_findings; ++p) {
            if (!is_unexpected[p]) continue;
            finding.place = most(parts[p]);
            const auto expected = std::find(is_unexpected.begin(), is_unexpected.end(), false);
            finding.first_place = most(parts[static_cast<std::size_t>(expected - is_unexpected.begin())]);
            out.push_back(finding);
        }
        return out;
    }

  private:
    /// Side of the cells of a level.
    double cell_size(int level) const { return step_ * (1u << (levels - level)); }

    /// Enclosures over the cells of this size with these indices, widened by `margin` cells on every side.
    std::vector<Interval> ranges(Evaluator& evaluator, std::span<const Index> cells, double size,
                                 double margin = 0) const {
        std::array<std::vector<Interval>, 3> columns;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const Index& cell : cells) {
                const double low = low_[axis] + size * (cell[axis] - margin);
                const double high = low_[axis] + size * (cell[axis] + 1 + margin);
                columns[axis].push_back(options_.axes[axis] ? Interval(low, high) : Interval(0));
            }
        }
        const Interval* boxes[] = {columns[0].data(), columns[1].data(), columns[2].data()};
        std::vector<Interval> out(cells.size());
        evaluator.intervals(boxes, cells.size(), out.data());
        return out;
    }

    /// The cells in which the blend may change the shape, divided to `level` or until they are many.
    std::vector<Index> open_cells(Evaluator& activity, Evaluator& whole, Evaluator& plain, int& level) const {
        std::vector<Index> cells{{0, 0, 0}};
        for (int at = 0;; ++at) {
            std::vector<Index> active;
            const std::vector<Interval> act = ranges(activity, cells, cell_size(at));
            for (std::size_t i = 0; i < cells.size(); ++i)
                if (act[i].hi > 0 || act[i].maybe_undefined) active.push_back(cells[i]);
            const std::vector<Interval> with = ranges(whole, active, cell_size(at)),
                                        without = ranges(plain, active, cell_size(at));
            cells.clear();
            for (std::size_t i = 0; i < active.size(); ++i) {
                const bool both_in = with[i].surely_not_negative() && without[i].surely_not_negative();
                const bool both_out =
                    (with[i].is_empty() || with[i].hi < 0) && (without[i].is_empty() || without[i].hi < 0);
                if (!both_in && !both_out) cells.push_back(active[i]);
            }
            level = at;
            if (at == levels || cells.empty() || cells.size() > most_cells || job_.cancelled()) return cells;
            cells = children(cells, at + 1);
        }
    }

    std::vector<Index> children(const std::vector<Index>& cells, int level) const {
        std::vector<Index> out;
        for (const Index& cell : cells) {
            for (std::uint32_t c = 0; c < 8; ++c) {
                Index child{};
                bool is_new = true;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::uint32_t upper = c >> axis & 1u;
                    if (!options_.axes[axis]) {
                        is_new = is_new && upper == 0;
                        continue;
                    }
                    child[axis] = 2 * cell[axis] + upper;
                    is_new = is_new && (child[axis] << (levels - level)) < cells_[axis];
                }
                if (is_new) out.push_back(child);
            }
        }
        return out;
    }

    std::vector<Change> changes_in(const std::vector<Index>& cells, int level, Evaluator& whole,
                                   Evaluator& plain) const {
        std::size_t a_cell = 1;
        for (std::size_t k = 0; k < axes_.size(); ++k) a_cell *= samples_a_side;
        std::vector<Change> out;
        std::array<std::vector<double>, 3> columns;
        std::vector<Change> batch;
        const auto flush = [&] {
            std::vector<double> with(batch.size()), without(batch.size());
            const double* points[] = {columns[0].data(), columns[1].data(), columns[2].data()};
            double* first[] = {with.data()};
            double* second[] = {without.data()};
            whole.values(points, batch.size(), first);
            plain.values(points, batch.size(), second);
            for (std::size_t i = 0; i < batch.size(); ++i) {
                if ((with[i] >= 0) == (without[i] >= 0)) continue;
                out.push_back(batch[i]);
                const double amount = std::abs(with[i] - without[i]);
                out.back().amount = amount == amount ? amount : 0;
            }
            batch.clear();
            for (auto& column : columns) column.clear();
        };
        for (std::size_t c = 0; c < cells.size(); ++c) {
            for (std::size_t n = 0; n < a_cell; ++n) {
                Change change;
                std::array<double, 3> p{};
                std::size_t rest = n;
                for (const std::size_t axis : axes_) {
                    const auto k = static_cast<std::uint32_t>(rest % samples_a_side);
                    rest /= samples_a_side;
                    change.sample[axis] = cells[c][axis] * samples_a_side + k;
                    p[axis] = low_[axis] + cell_size(level) * (change.sample[axis] + 0.5) / samples_a_side;
                }
                change.place = {p[0], p[1], p[2]};
                batch.push_back(change);
                for (std::size_t axis = 0; axis < 3; ++axis) columns[axis].push_back(p[axis]);
            }
            if (batch.size() >= 4096) flush();
        }
        flush();
        return out;
    }

    /// The connected parts of the changed samples, largest first, without ragged ends.
    static std::vector<std::vector<std::size_t>> connected_parts(const std::vector<Change>& changes) {
        const auto key = [](const Index& s) { return (s[2] << 20) | (s[1] << 10) | s[0]; };
        std::unordered_map<std::uint32_t, std::size_t> number;
        for (std::size_t i = 0; i < changes.size(); ++i) number.emplace(key(changes[i].sample), i);
        std::vector<std::size_t> part(changes.size(), changes.size());
        std::vector<std::vector<std::size_t>> parts;
        for (std::size_t start = 0; start < changes.size(); ++start) {
            if (part[start] != changes.size()) continue;
            parts.emplace_back(1, start);
            part[start] = start;
            for (std::size_t next = 0; next < parts.back().size(); ++next) {
                const Index& at = changes[parts.back()[next]].sample;
                for (int n = 0; n < 125; ++n) {
                    const std::array<int, 3> d{n % 5 - reach, n / 5 % 5 - reach, n / 25 - reach};
                    Index s{};
                    bool is_in = true;
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        const int moved = static_cast<int>(at[axis]) + d[axis];
                        is_in = is_in && moved >= 0 && moved < 1024;
                        s[axis] = static_cast<std::uint32_t>(moved);
                    }
                    const auto found = is_in ? number.find(key(s)) : number.end();
                    if (found == number.end() || part[found->second] != changes.size()) continue;
                    part[found->second] = start;
                    parts.back().push_back(found->second);
                }
            }
        }
        std::stable_sort(parts.begin(), parts.end(),
                         [](const auto& a, const auto& b) { return a.size() > b.size(); });
        std::erase_if(parts, [&](const auto& p) {
            return p.size() < fewest_samples ||
                   static_cast<double>(p.size()) < smallest_part * static_cast<double>(parts.front().size());
        });
        return parts;
    }

    /// True when a point with f1 = f2 = 0 may lie within a step of a sample of the part.
    bool touches_joint(const std::vector<std::size_t>& part, const std::vector<Change>& changes, int level,
                       Evaluator& first, Evaluator& second) const {
        constexpr std::size_t batch = 256;
        const double size = cell_size(level) / samples_a_side;
        for (std::size_t begin = 0; begin < part.size(); begin += batch) {
            std::vector<Index> near;
            for (std::size_t i = begin; i < std::min(begin + batch, part.size()); ++i)
                near.push_back(changes[part[i]].sample);
            const std::vector<Interval> f1 = ranges(first, near, size, 1), f2 = ranges(second, near, size, 1);
            for (std::size_t i = 0; i < near.size(); ++i)
                if (f1[i].contains(0) && f2[i].contains(0)) return true;
        }
        return false;
    }

    const Field& field_;
    const BlendCheckOptions& options_;
    std::vector<std::size_t> axes_;
    const Job& job_;
    std::array<double, 3> low_{};
    double step_ = 1;       ///< side of the smallest cells
    Index cells_{1, 1, 1};  ///< of the smallest size, along each axis
};

}  // namespace

Result<std::vector<BlendFinding>> check_blends(const Field& field, const BlendCheckOptions& options,
                                               const Job& job) {
    const Box3& box = options.bounds;
    const std::array<double, 3> low{box.min.x, box.min.y, box.min.z}, high{box.max.x, box.max.y, box.max.z};
    std::vector<std::size_t> axes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!options.axes[axis]) continue;
        axes.push_back(axis);
        const double side = high[axis] - low[axis];
        if (!(side > 0) || !(side - side == 0))
            return Error{ErrorKind::invalid_argument, "the box is empty or has no end"};
    }
    std::vector<NodeId> blends;
    const NodeId roots[] = {field.value};
    const std::vector<bool> needed = reachable(*field.graph, roots);
    for (NodeId id = 0; id < field.graph->size() && id < needed.size(); ++id)
        if (needed[id] && is_blend(field.graph->node(id).op) && !is_off(field, id)) blends.push_back(id);
    std::vector<std::vector<BlendFinding>> found(blends.size());
    parallel_for(job, blends.size(), [&](std::size_t i) {
        found[i] = BlendSearch(field, options, axes, job).findings(blends[i]);
    });
    if (job.cancelled()) return Error{ErrorKind::cancelled, "cancelled"};
    std::vector<BlendFinding> out;
    for (std::size_t i = 0; i < blends.size(); ++i) {
        // a place of the text that is used several times acts if it acts once, and is told of once
        bool is_told = false;
        for (std::size_t j = 0; j < blends.size() && !found[i].empty(); ++j) {
            if (field.graph->origin(blends[i]) != field.graph->origin(blends[j])) continue;
            const bool acts = found[j].empty() || found[j][0].flaw != BlendFlaw::never_acts;
            is_told = is_told || (found[i][0].flaw == BlendFlaw::never_acts && (acts || j < i));
        }
        if (!is_told) out.insert(out.end(), found[i].begin(), found[i].end());
    }
    return out;
}

}  // namespace frep
