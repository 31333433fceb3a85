// The scalar interpreter of regions; semantics in field/region.h. Recursion is over the nesting of
// statements, which is at most Region::nesting_limit deep.
#include <algorithm>

#include "frep/eval/reference.h"
#include "frep/eval/region_nodes.h"
#include "frep/field/kernels/basic.h"
#include "frep/field/meaning.h"

namespace frep {
namespace {

template <class T>
T undefined() {
    return math::constant<T>(math::quiet_nan);
}

double number_of(double value) { return value; }
double number_of(const math::Dual<double>& value) { return value.value; }

/// Item of an array, counted from 0; -1 when the index is undefined or out of range.
std::int64_t item_of(double index, const RegionArray& array) {
    const double rounded = math::round_half_up(index);
    if (!(rounded >= 1.0) || rounded > static_cast<double>(array.size)) return -1;
    return static_cast<std::int64_t>(rounded) - 1;
}

}  // namespace

template <class T>
ScalarRegion<T>::ScalarRegion(const Region& region, std::int64_t max_steps)
    : region_(region),
      max_steps_(max_steps),
      needed_(nodes_by_statement(region)),
      cells_(region.cell_count),
      values_(region.body.size()) {}

template <class T>
void ScalarRegion<T>::run(std::span<const T> arguments) {
    std::fill(cells_.begin(), cells_.end(), undefined<T>());
    failed_ = nullptr;
    steps_ = 0;
    searched_ = 0;
    if (!kernels::is_true(number_of(arguments[0]))) return;  // not true where undefined
    for (std::size_t k = 0; k < region_.inputs.size(); ++k) cells_[region_.inputs[k]] = arguments[k + 1];
    if (!execute(region_.program)) std::fill(cells_.begin(), cells_.end(), undefined<T>());
}

/// False when the region becomes undefined.
template <class T>
bool ScalarRegion<T>::execute(std::span<const std::uint32_t> statements) {
    for (const std::uint32_t number : statements) {
        const RegionStatement& statement = region_.statements[number];
        if (statement.kind == RegionStatement::Kind::loop) {
            if (!execute_loop(statement, number)) return false;
            continue;
        }
        if (statement.kind == RegionStatement::Kind::search) {
            if (!search(statement, number)) return false;
            continue;
        }
        evaluate(number);
        if (statement.kind == RegionStatement::Kind::assign) {
            for (const auto& [cell, node] : statement.assignments) cells_[cell] = values_[node];
        } else if (statement.kind == RegionStatement::Kind::store) {
            store(statement);
        } else {
            const double condition = number_of(values_[statement.condition]);
            if (math::is_nan(condition)) {
                failed_ = &statement;
                return false;
            }
            if (!execute(kernels::is_true(condition) ? statement.first : statement.second)) return false;
        }
    }
    return true;
}

template <class T>
bool ScalarRegion<T>::execute_loop(const RegionStatement& statement, std::uint32_t number) {
    for (;;) {
        evaluate(number);
        const double condition = number_of(values_[statement.condition]);
        if (math::is_nan(condition) || (kernels::is_true(condition) && steps_ >= max_steps_)) {
            failed_ = &statement;
            return false;
        }
        if (!kernels::is_true(condition)) return true;
        ++steps_;
        if (!execute(statement.first)) return false;
    }
}

template <class T>
bool ScalarRegion<T>::search(const RegionStatement& statement, std::uint32_t number) {
    if (!searcher_) searcher_ = std::make_unique<IntervalRegion>(region_, max_steps_);
    const auto content = [&](std::uint32_t cell) { return number_of(cells_[cell]); };
    const BoxSearchResult found = searcher_->search_at(number, content, searched_);
    if (!found.finished) {
        failed_ = &statement;
        return false;
    }
    for (std::size_t i = 0; i < statement.variables.size(); ++i)
        cells_[statement.variables[i]] = math::constant<T>(found.place[i]);
    if (!execute(statement.first)) return false;
    evaluate(number);
    cells_[statement.result] = values_[statement.value];
    return true;
}

template <class T>
void ScalarRegion<T>::evaluate(std::uint32_t number) {
    const Graph& body = region_.body;
    for (const NodeId id : needed_[number]) {
        const Node& node = body.node(id);
        arguments_.clear();
        for (const NodeId argument : body.arguments(id)) arguments_.push_back(values_[argument]);
        switch (node.op) {
            case Op::constant:
                values_[id] = math::constant<T>(body.constant_of(id));
                break;
            case Op::cell:
                values_[id] = cells_[node.payload];
                break;
            case Op::load:
                values_[id] = load(node);
                break;
            case Op::undefined:
                values_[id] = undefined<T>();
                break;
            default:
                values_[id] = meaning<T>(node.op, arguments_, body.block_of(id));
        }
    }
}

template <class T>
T ScalarRegion<T>::load(const Node& node) const {
    const RegionArray& array = region_.arrays[node.payload];
    const std::int64_t item = item_of(number_of(arguments_[0]), array);
    return item < 0 ? undefined<T>() : cells_[array.first_cell + static_cast<std::size_t>(item)];
}

template <class T>
void ScalarRegion<T>::store(const RegionStatement& statement) {
    const RegionArray& array = region_.arrays[statement.array];
    const std::int64_t item = item_of(number_of(values_[statement.index]), array);
    const auto first = cells_.begin() + array.first_cell;
    if (item < 0)
        std::fill(first, first + array.size, undefined<T>());
    else
        first[item] = values_[statement.value];
}

template class ScalarRegion<double>;
template class ScalarRegion<math::Dual<double>>;

}  // namespace frep
