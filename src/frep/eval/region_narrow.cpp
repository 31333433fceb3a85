// Implementation of region_narrow.h. What is known is known of computed values, so that a bound of a rounded
// result is widened by one place before it is carried to the operands. Recursion stops at a fixed depth,
// where nothing more is learned.
#include "frep/eval/region_narrow.h"

#include <algorithm>
#include <vector>

#include "frep/math/functions.h"

namespace frep {

namespace {

using math::Interval;

constexpr int depth_limit = 12, visit_limit = 256;

/// The values that both hold, and no undefined one.
Interval common(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }

/// Exact results that round to a value of `a`.
Interval unrounded(Interval a) { return {math::next_down(a.lo), math::next_up(a.hi)}; }

class Narrower {
  public:
    Narrower(const Graph& body, std::span<const Interval> values,
             std::span<const std::pair<std::uint32_t, NodeId>> assigned, std::span<Interval> cells)
        : body_(body), values_(values), assigned_(assigned), cells_(cells) {}

    /// The node is a truth value: defined, and true or false.
    bool decide(NodeId id, bool truth, int depth) {
        if (depth == depth_limit) return true;
        const auto arguments = body_.arguments(id);
        switch (body_.node(id).op) {
            case Op::logical_not:
                return decide(arguments[0], !truth, depth + 1);
            case Op::logical_and:
                return truth ? both(arguments, true, depth) : either(arguments, false, depth);
            case Op::logical_or:
                return truth ? either(arguments, true, depth) : both(arguments, false, depth);
            case Op::less:
            case Op::less_equal: {
                // The bounds are closed: a strict one says no more about a range.
                const NodeId small = arguments[truth ? 0 : 1], large = arguments[truth ? 1 : 0];
                return limit(small, {-math::infinity, values_[large].hi}, depth + 1) &&
                       limit(large, {values_[small].lo, math::infinity}, depth + 1);
            }
            default:
                return true;
        }
    }

  private:
    bool both(std::span<const NodeId> arguments, bool truth, int depth) {
        return decide(arguments[0], truth, depth + 1) && decide(arguments[1], truth, depth + 1);
    }

    /// What the first allows and what the second allows, joined.
    bool either(std::span<const NodeId> arguments, bool truth, int depth) {
        if (depth > 2) return true;  // every level copies the cells twice
        const std::vector<Interval> before(cells_.begin(), cells_.end());
        const bool first = decide(arguments[0], truth, depth + 1);
        const std::vector<Interval> after(cells_.begin(), cells_.end());
        std::copy(before.begin(), before.end(), cells_.begin());
        const bool second = decide(arguments[1], truth, depth + 1);
        if (!second) std::copy(after.begin(), after.end(), cells_.begin());
        if (first && second)
            for (std::size_t i = 0; i < after.size(); ++i) cells_[i] = math::hull(cells_[i], after[i]);
        return first || second;
    }

    /// The node is defined and lies in `range`.
    bool limit(NodeId id, Interval range, int depth) {
        if (range.is_empty() || values_[id].is_empty()) return false;
        range = common(range, values_[id]);
        if (range.is_empty()) return false;
        if (!limit_cells(id, range)) return false;
        if (depth == depth_limit || ++visits_ > visit_limit) return true;
        const auto arguments = body_.arguments(id);
        switch (body_.node(id).op) {
            case Op::neg:
                return limit(arguments[0], -range, depth + 1);
            case Op::abs:
                return limit_size(arguments[0], range, depth);
            case Op::square: {
                const Interval root = math::sqrt(unrounded(range));
                return root.is_empty() ? false : limit_size(arguments[0], root, depth);
            }
            case Op::pow: {
                if (body_.node(arguments[1]).op != Op::constant || body_.constant_of(arguments[1]) != 2)
                    return true;
                // A base below 1e-6 counts as 0 (numerics.md, rule 8).
                const Interval root = math::sqrt(unrounded(range));
                return root.is_empty() ? false
                                       : limit_size(arguments[0], {root.lo, std::max(root.hi, 1e-6)}, depth);
            }
            case Op::sqrt:
                return limit(arguments[0], unrounded(math::square(unrounded(range))), depth + 1);
            case Op::add:
            case Op::sub:
                return limit_sum(id, unrounded(range), depth);
            default:
                return true;
        }
    }

    /// The cells that hold the node's value have it in `range`.
    bool limit_cells(NodeId id, Interval range) {
        const auto put = [&](std::uint32_t number) {
            cells_[number] = common(cells_[number], range);
            return !cells_[number].is_empty();
        };
        const Node& node = body_.node(id);
        bool holds = node.op == Op::cell;  // its content is what was read, unless it was written since
        for (const auto& [cell, value] : assigned_) {
            if (holds && cell == node.payload) holds = false;
            if (value == id && !put(cell)) return false;
        }
        return !holds || put(node.payload);
    }

    /// The size of the node lies in `range`.
    bool limit_size(NodeId id, Interval range, int depth) {
        const Interval value = values_[id];
        const double least = std::max(range.lo, 0.0);
        if (value.lo > -least) return limit(id, {least, range.hi}, depth + 1);
        if (value.hi < least) return limit(id, {-range.hi, -least}, depth + 1);
        return limit(id, {-range.hi, range.hi}, depth + 1);
    }

    /// Each operand is what the sum leaves when the other one is taken away. Infinite ones tell nothing.
    bool limit_sum(NodeId id, Interval sum, int depth) {
        const auto arguments = body_.arguments(id);
        const bool minus = body_.node(id).op == Op::sub;
        const Interval a = values_[arguments[0]], b = minus ? -values_[arguments[1]] : values_[arguments[1]];
        const auto rest = [&](Interval other) {
            const Interval left = sum - Interval(other.lo, other.hi);
            return left.is_empty() || left.maybe_undefined ? Interval::entire() : left;
        };
        const Interval second = rest(a);
        return limit(arguments[0], rest(b), depth + 1) &&
               limit(arguments[1], minus ? -second : second, depth + 1);
    }

    const Graph& body_;
    std::span<const Interval> values_;
    std::span<const std::pair<std::uint32_t, NodeId>> assigned_;
    std::span<Interval> cells_;
    int visits_ = 0;
};

}  // namespace

bool narrow(const Graph& body, std::span<const Interval> values, NodeId condition, bool truth,
            std::span<const std::pair<std::uint32_t, NodeId>> assigned, std::span<Interval> cells) {
    return Narrower(body, values, assigned, cells).decide(condition, truth, 0);
}

}  // namespace frep
