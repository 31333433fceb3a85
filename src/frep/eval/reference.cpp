// The scalar walk over the graph; see reference.h. Regions are in reference_region.cpp.
#include "frep/eval/reference.h"

#include "frep/eval/float_control.h"
#include "frep/field/kernels/basic.h"
#include "frep/field/meaning.h"

namespace frep {
namespace {

template <class T>
T undefined() {
    return math::constant<T>(math::quiet_nan);
}

}  // namespace

template <class T>
GraphWalk<T>::GraphWalk(const Field& field, std::span<const NodeId> roots, std::int64_t max_steps)
    : field_(field), values_(field.graph->size(), undefined<T>()) {
    const std::vector<bool> needed = reachable(*field.graph, roots);
    for (NodeId id = 0; id < needed.size(); ++id) {
        if (!needed[id]) continue;
        order_.push_back(id);
        if (field.graph->node(id).op == Op::region)
            regions_.try_emplace(id, field.graph->region_of(id), max_steps);
    }
}

template <class T>
void GraphWalk<T>::run(std::span<const T> coordinates) {
    for (const NodeId id : order_) values_[id] = compute(id, coordinates);
}

template <class T>
T GraphWalk<T>::compute(NodeId id, std::span<const T> coordinates) {
    const Graph& graph = *field_.graph;
    const Node& node = graph.node(id);
    if (node.op == Op::output) return regions_.at(graph.arguments(id)[0]).cells()[node.payload];
    arguments_.clear();
    for (const NodeId argument : graph.arguments(id)) arguments_.push_back(values_[argument]);
    switch (node.op) {
        case Op::constant:
            return math::constant<T>(graph.constant_of(id));
        case Op::coordinate:
            return coordinates[node.payload];
        case Op::parameter:
            return math::constant<T>(field_.parameters[node.payload]);
        case Op::region:
            regions_.at(id).run(arguments_);
            return undefined<T>();
        case Op::undefined:
            return undefined<T>();
        default:
            return meaning<T>(node.op, arguments_, graph.block_of(id));
    }
}

template <class T>
auto GraphWalk<T>::region(NodeId id) const -> const RegionRun* {
    const auto found = regions_.find(id);
    return found == regions_.end() ? nullptr : &found->second;
}

template class GraphWalk<double>;
template class GraphWalk<math::Dual<double>>;
template class GraphWalk<math::Interval>;

namespace {

class Reference final : public Evaluator {
  public:
    Reference(const Field& field, const EvaluatorOptions& options)
        : field_(field),
          options_(options),
          roots_(options.attributes ? field.roots() : std::vector<NodeId>{field.value}),
          values_(field_, roots_, options.max_steps) {}

    std::unique_ptr<Evaluator> clone() const override {
        return std::make_unique<Reference>(field_, options_);
    }
    int coordinates() const override { return field_.coordinates; }
    int outputs() const override { return static_cast<int>(roots_.size()); }

    void values(std::span<const double* const> coordinates, std::size_t count,
                std::span<double* const> out) override {
        const FloatControl control;
        std::vector<double> point(static_cast<std::size_t>(field_.coordinates));
        for (std::size_t p = 0; p < count; ++p) {
            for (std::size_t i = 0; i < point.size(); ++i) point[i] = coordinates[i][p];
            values_.run(point);
            for (std::size_t k = 0; k < out.size(); ++k) out[k][p] = values_.value(roots_[k]);
        }
    }

    void gradients(std::span<const double* const> coordinates, std::size_t count, double* values,
                   std::span<double* const> partials) override {
        const FloatControl control;
        if (!duals_) duals_ = std::make_unique<GraphWalk<math::Dual<double>>>(field_, roots_of_f(), steps());
        for (std::size_t p = 0; p < count; ++p) gradient(coordinates, p, values, partials);
    }

    void intervals(std::span<const math::Interval* const> coordinates, std::size_t count,
                   math::Interval* out) override {
        const FloatControl control;
        if (!boxes_) boxes_ = std::make_unique<GraphWalk<math::Interval>>(field_, roots_of_f(), steps());
        std::vector<math::Interval> box(static_cast<std::size_t>(field_.coordinates));
        for (std::size_t p = 0; p < count; ++p) {
            for (std::size_t i = 0; i < box.size(); ++i) box[i] = coordinates[i][p];
            boxes_->run(box);
            out[p] = boxes_->value(field_.value);
        }
    }

  private:
    std::span<const NodeId> roots_of_f() const { return {&field_.value, 1}; }
    std::int64_t steps() const { return options_.max_steps; }

    /// Three directions a pass; without coordinates one pass for the value.
    void gradient(std::span<const double* const> coordinates, std::size_t p, double* values,
                  std::span<double* const> partials) {
        const auto n = static_cast<std::size_t>(field_.coordinates);
        std::vector<math::Dual<double>> point(n);
        std::size_t first = 0;
        do {
            for (std::size_t i = 0; i < n; ++i) {
                const double x = coordinates[i][p];
                const bool moves = i >= first && i < first + 3;
                point[i] = moves ? math::Dual<double>::variable(x, static_cast<int>(i - first))
                                 : math::Dual<double>(x);
            }
            duals_->run(point);
            const math::Dual<double>& f = duals_->value(field_.value);
            values[p] = f.value;
            for (std::size_t i = first; i < n && i < first + 3; ++i) partials[i][p] = f.d[i - first];
            first += 3;
        } while (first < n);
    }

    const Field field_;
    const EvaluatorOptions options_;
    const std::vector<NodeId> roots_;
    GraphWalk<double> values_;
    std::unique_ptr<GraphWalk<math::Dual<double>>> duals_;
    std::unique_ptr<GraphWalk<math::Interval>> boxes_;
};

}  // namespace

std::unique_ptr<Evaluator> make_reference(const Field& field, const EvaluatorOptions& options) {
    return std::make_unique<Reference>(field, options);
}

}  // namespace frep
