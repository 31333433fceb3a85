// Implementation of narrowed_field.h.
#include "frep/eval/narrowed_field.h"

#include <algorithm>
#include <optional>

#include "frep/eval/axis_columns.h"
#include "frep/eval/batch_vm.h"
#include "frep/eval/float_control.h"
#include "frep/eval/prune.h"

namespace frep {

struct Narrowing::Engines {
    explicit Engines(AxisMap map) : columns(std::move(map)) {}
    AxisColumns columns;
    Pruner pruner;
    BatchVm<double> vm;
    BoxLanes boxes;
    RangeLanes ranges;
    CutResult cut;
};

/// A part of a field. Values off its surface are its own.
class NarrowedField final : public SampledField {
  public:
    NarrowedField(std::shared_ptr<Narrowing> narrowing, ClauseTape tape)
        : narrowing_(std::move(narrowing)), tape_(std::move(tape)) {}

    std::unique_ptr<SampledField> clone() const override {
        auto own = std::make_shared<Narrowing>(narrowing_->engines_->columns.map());
        return std::make_unique<NarrowedField>(std::move(own), tape_);
    }

    void values(const PointSpans& points, std::span<double> out) override {
        Narrowing::Engines& e = *narrowing_->engines_;
        e.vm.values(packed(), e.columns.coordinates(points), points.size(), out.data());
    }

    void gradients(const PointSpans& points, std::span<double> values, const GradientSpans& out) override {
        Narrowing::Engines& e = *narrowing_->engines_;
        const auto coordinates = e.columns.coordinates(points);
        e.vm.gradients(packed(), coordinates, points.size(), values.data(),
                       e.columns.partials(points.size()));
        e.columns.sum_partials(out);
    }

    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        narrowing_->ranges(tape_, boxes, out);
    }

    bool has_dear_ranges() const override { return frep::has_dear_ranges(tape_); }
    void narrow(std::span<const Box3> boxes, std::span<SignRange> out,
                std::span<std::shared_ptr<SampledField>> parts) override {
        Narrowing::narrow(narrowing_, tape_, boxes, out, parts);
    }

  private:
    /// Rows are shared only where there are enough of them to leave the first cache.
    static constexpr std::size_t few_clauses = 32;
    const ClauseTape& packed() {
        if (tape_.clauses.size() <= few_clauses) return tape_;
        if (!packed_) {
            packed_ = tape_;
            pack_rows(*packed_);
        }
        return *packed_;
    }

    std::shared_ptr<Narrowing> narrowing_;
    ClauseTape tape_;
    std::optional<ClauseTape> packed_;
};

namespace {

SignRange signs_of(const RangeLanes& ranges, unsigned lane) {
    const auto holds = [&](std::uint16_t mask) { return (mask >> lane & 1U) != 0; };
    const bool can_be_undefined = holds(ranges.can_be_undefined);
    // The mask of outside counts undefined as outside; here the two are told apart.
    const bool can_be_negative = holds(ranges.can_be_outside) && !(can_be_undefined && ranges.lo[lane] >= 0);
    return {holds(ranges.can_be_inside), can_be_negative, can_be_undefined};
}

}  // namespace

bool has_dear_ranges(const ClauseTape& tape) {
    constexpr double most = 120;  // additions' worth
    constexpr int dear_cost = 30;
    double cost = 0;
    for (const Clause& clause : tape.clauses)
        if (info(clause.op).kind == OpKind::block || info(clause.op).cost >= dear_cost)
            cost += cost_of(tape, clause);
    return cost > most;
}

Narrowing::Narrowing(AxisMap map) : engines_(std::make_unique<Engines>(std::move(map))) {}
Narrowing::~Narrowing() = default;

void Narrowing::load_boxes(std::span<const Box3> boxes) {
    Engines& e = *engines_;
    e.boxes.count = static_cast<int>(boxes.size());
    for (std::size_t i = 0; i < e.columns.count(); ++i)
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            const math::Interval side = e.columns.side(boxes[b], i);
            e.boxes.lo[i][b] = side.lo;
            e.boxes.hi[i][b] = side.hi;
        }
}

void Narrowing::ranges(const ClauseTape& tape, std::span<const Box3> boxes, std::span<SignRange> out) {
    const FloatControl control;
    for (std::size_t first = 0; first < boxes.size(); first += tile_lanes) {
        const std::size_t count = std::min<std::size_t>(tile_lanes, boxes.size() - first);
        load_boxes(boxes.subspan(first, count));
        engines_->pruner.ranges(tape, engines_->boxes, engines_->ranges);
        for (unsigned b = 0; b < count; ++b) out[first + b] = signs_of(engines_->ranges, b);
    }
}

void Narrowing::narrow(const std::shared_ptr<Narrowing>& self, const ClauseTape& tape,
                       std::span<const Box3> boxes, std::span<SignRange> out,
                       std::span<std::shared_ptr<SampledField>> parts) {
    const FloatControl control;
    Engines& e = *self->engines_;
    std::array<std::shared_ptr<SampledField>, tile_lanes> made;
    for (std::size_t first = 0; first < boxes.size(); first += tile_lanes) {
        const std::size_t count = std::min<std::size_t>(tile_lanes, boxes.size() - first);
        self->load_boxes(boxes.subspan(first, count));
        e.pruner.cut(tape, e.boxes, Purpose::sign, e.cut);
        for (int t = 0; t < e.cut.tape_count; ++t) {
            const auto n = static_cast<std::size_t>(t);
            made[n] = std::make_shared<NarrowedField>(self, e.cut.tapes[n]);
        }
        for (unsigned b = 0; b < count; ++b) {
            out[first + b] = signs_of(e.cut.ranges, b);
            const std::int8_t number = e.cut.tape_of[b];
            parts[first + b] = number >= 0 ? made[static_cast<std::size_t>(number)] : nullptr;
        }
    }
}

}  // namespace frep
