// Implementation of narrowed_field.h.
#include "frep/eval/narrowed_field.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "frep/eval/axis_columns.h"
#include "frep/eval/float_control.h"
#include "frep/eval/prune.h"
#include "frep/eval/tape_code.h"

namespace frep {

struct Narrowing::Engines {
    explicit Engines(AxisMap map) : columns(std::move(map)) {}
    AxisColumns columns;
    Pruner pruner;
    BatchVm<double> vm;
    TapeCodes codes;
    BoxLanes boxes;
    RangeLanes ranges;
    CutResult cut;
    std::vector<std::size_t> open;            ///< points to be looked at again
    std::array<std::vector<double>, 4> some;  ///< their coordinates and values
};

/// A part of a field. Values off its surface are its own.
class NarrowedField final : public SampledField {
  public:
    NarrowedField(std::shared_ptr<Narrowing> narrowing, std::shared_ptr<TapeCode> code)
        : narrowing_(std::move(narrowing)), code_(std::move(code)) {}

    std::unique_ptr<SampledField> clone() const override {
        auto own = std::make_shared<Narrowing>(narrowing_->engines_->columns.map());
        return std::make_unique<NarrowedField>(std::move(own), std::make_shared<TapeCode>(code_->tape()));
    }

    void values(const PointSpans& points, std::span<double> out) override {
        narrowing_->values(*code_, points, out);
    }

    void gradients(const PointSpans& points, std::span<double> values, const GradientSpans& out) override {
        Narrowing::Engines& e = *narrowing_->engines_;
        const auto coordinates = e.columns.coordinates(points);
        code_->gradients(e.vm, coordinates, points.size(), values.data(), e.columns.partials(points.size()));
        e.columns.sum_partials(out);
    }

    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        narrowing_->ranges(code_->tape(), boxes, out);
    }

    bool has_dear_ranges() const override { return frep::has_dear_ranges(code_->tape()); }
    void narrow(std::span<const Box3> boxes, std::span<SignRange> out,
                std::span<std::shared_ptr<SampledField>> parts) override {
        Narrowing::narrow(narrowing_, code_->tape(), boxes, out, parts);
    }

    void narrow_signs(std::span<const Box3> boxes, std::span<std::shared_ptr<SampledField>> near) override {
        Narrowing::narrow_signs(narrowing_, code_, boxes, near);
    }

  private:
    std::shared_ptr<Narrowing> narrowing_;
    std::shared_ptr<TapeCode> code_;
};

/// The signs of a field: its tape without small terms of sums, and the whole one where that does not decide.
class NearField final : public SampledField {
  public:
    NearField(std::shared_ptr<Narrowing> narrowing, std::shared_ptr<TapeCode> near,
              std::shared_ptr<TapeCode> exact, double error)
        : narrowing_(std::move(narrowing)), near_(std::move(near)), exact_(std::move(exact)), error_(error) {}

    std::unique_ptr<SampledField> clone() const override {
        return std::make_unique<NearField>(std::make_shared<Narrowing>(narrowing_->engines_->columns.map()),
                                           std::make_shared<TapeCode>(near_->tape()),
                                           std::make_shared<TapeCode>(exact_->tape()), error_);
    }

    void values(const PointSpans& points, std::span<double> out) override {
        narrowing_->values(*near_, points, out);
        narrowing_->redo(*exact_, points, out, [this](double f) { return f >= -error_ && f <= error_; });
    }

    void gradients(const PointSpans& points, std::span<double> values, const GradientSpans& out) override {
        NarrowedField(narrowing_, exact_).gradients(points, values, out);
    }
    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        narrowing_->ranges(exact_->tape(), boxes, out);
    }

  private:
    std::shared_ptr<Narrowing> narrowing_;
    std::shared_ptr<TapeCode> near_, exact_;
    double error_;
};

namespace {

/// Tapes that are as cheap as this are not worth a second look. In additions.
constexpr double least_near_cost = 200;
/// How much of the cost may be left where terms of sums are left out.
constexpr double worthwhile_part = 0.75;
/// How much of the range of F in a box the terms left out may come to.
constexpr double near_share = 0x1p-9;

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

void Narrowing::values(TapeCode& code, const PointSpans& points, std::span<double> out) {
    code.values(engines_->vm, engines_->columns.coordinates(points), points.size(), out.data());
}

/// Values by `code` at those points where there are some that `is_open` holds for.
template <class IsOpen>
void Narrowing::redo(TapeCode& code, const PointSpans& points, std::span<double> out, IsOpen is_open) {
    Engines& e = *engines_;
    e.open.clear();
    for (std::vector<double>& column : e.some) column.clear();
    for (std::size_t p = 0; p < out.size(); ++p) {
        if (!is_open(out[p])) continue;
        e.open.push_back(p);
        e.some[0].push_back(points.x[p]);
        e.some[1].push_back(points.y[p]);
        e.some[2].push_back(points.z[p]);
    }
    if (e.open.empty()) return;
    e.some[3].resize(e.open.size());
    values(code, {e.some[0], e.some[1], e.some[2]}, e.some[3]);
    for (std::size_t k = 0; k < e.open.size(); ++k) out[e.open[k]] = e.some[3][k];
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
            made[n] = std::make_shared<NarrowedField>(self, e.codes.code_for(e.cut.tapes[n]));
        }
        for (unsigned b = 0; b < count; ++b) {
            out[first + b] = signs_of(e.cut.ranges, b);
            const std::int8_t number = e.cut.tape_of[b];
            parts[first + b] = number >= 0 ? made[static_cast<std::size_t>(number)] : nullptr;
        }
    }
}

void Narrowing::narrow_signs(const std::shared_ptr<Narrowing>& self, const std::shared_ptr<TapeCode>& code,
                             std::span<const Box3> boxes, std::span<std::shared_ptr<SampledField>> near) {
    const FloatControl control;
    for (std::shared_ptr<SampledField>& field : near) field = nullptr;
    const double whole_cost = cost_of(code->tape());
    if (whole_cost < least_near_cost) return;
    Engines& e = *self->engines_;
    for (std::size_t first = 0; first < boxes.size(); first += tile_lanes) {
        const std::size_t count = std::min<std::size_t>(tile_lanes, boxes.size() - first);
        self->load_boxes(boxes.subspan(first, count));
        const double error = e.pruner.cut_near(code->tape(), e.boxes, near_share, e.cut);
        if (!(error <= std::numeric_limits<double>::max())) continue;
        std::array<std::shared_ptr<SampledField>, tile_lanes> made;
        for (std::size_t t = 0; t < static_cast<std::size_t>(e.cut.tape_count); ++t)
            if (cost_of(e.cut.tapes[t]) < worthwhile_part * whole_cost)
                made[t] = std::make_shared<NearField>(self, e.codes.code_for(e.cut.tapes[t]), code, error);
        for (unsigned b = 0; b < count; ++b)
            if (const std::int8_t number = e.cut.tape_of[b]; number >= 0)
                near[first + b] = made[static_cast<std::size_t>(number)];
    }
}

}  // namespace frep
