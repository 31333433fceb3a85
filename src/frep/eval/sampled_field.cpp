// The adaptor from eval's Evaluator to SampledField; see sampled_field.h.
#include "frep/eval/sampled_field.h"

#include <fmt/format.h>

#include <utility>

#include "frep/eval/axis_columns.h"
#include "frep/eval/clause_tape.h"
#include "frep/eval/narrowed_field.h"
#include "frep/eval/tape_code.h"

namespace frep {

namespace {

class MappedField final : public SampledField {
  public:
    MappedField(std::unique_ptr<Evaluator> evaluator, const AxisMap& map, double iso)
        : evaluator_(std::move(evaluator)), columns_(map), iso_(iso) {}

    std::unique_ptr<SampledField> clone() const override {
        return std::make_unique<MappedField>(evaluator_->clone(), columns_.map(), iso_);
    }

    void values(const PointSpans& points, std::span<double> out) override {
        if (narrowing_ && code_->tape().clauses.size() <= most_clauses)
            return narrowing_->values(*code_, points, out);
        outputs_.assign(1, out.data());
        evaluator_->values(columns_.coordinates(points), points.size(), outputs_);
        for (double& f : out) f -= iso_;
    }

    void gradients(const PointSpans& points, std::span<double> values, const GradientSpans& out) override {
        const auto coordinates = columns_.coordinates(points);
        evaluator_->gradients(coordinates, points.size(), values.data(), columns_.partials(points.size()));
        columns_.sum_partials(out);
        for (double& f : values) f -= iso_;
    }

    std::size_t attribute_count() const override {
        return static_cast<std::size_t>(evaluator_->outputs()) - 1;
    }

    void attributes(const PointSpans& points, std::span<const std::span<double>> out) override {
        FREP_CHECK(out.size() <= attribute_count());
        const std::size_t count = points.size();
        unused_.resize((attribute_count() + 1 - out.size()) * count);
        outputs_.assign(1, unused_.data());
        for (const std::span<double>& column : out) outputs_.push_back(column.data());
        for (std::size_t k = 1; outputs_.size() <= attribute_count(); ++k)
            outputs_.push_back(unused_.data() + k * count);
        evaluator_->values(columns_.coordinates(points), count, outputs_);
    }

    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        const std::size_t count = boxes.size();
        const std::size_t n = columns_.count();
        intervals_.resize((n + 1) * count);
        interval_inputs_.clear();
        for (std::size_t i = 0; i < n; ++i) {
            math::Interval* column = &intervals_[i * count];
            for (std::size_t b = 0; b < count; ++b) column[b] = columns_.side(boxes[b], i);
            interval_inputs_.push_back(column);
        }
        math::Interval* result = intervals_.data() + n * count;
        evaluator_->intervals(interval_inputs_, count, result);
        for (std::size_t b = 0; b < count; ++b) {
            const math::Interval& f = result[b];
            out[b] = {f.hi >= iso_ && !f.is_empty(), f.lo < iso_ && !f.is_empty(), f.maybe_undefined};
        }
    }

    void quick_ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        if (has_narrowing())
            narrowing_->ranges(code_->tape(), boxes, out);
        else
            ranges(boxes, out);
    }

    bool has_dear_ranges() const override {
        return !evaluator_->clauses() || frep::has_dear_ranges(*evaluator_->clauses());
    }

    bool can_be_narrowed() const override { return evaluator_->clauses() != nullptr; }

    void narrow(std::span<const Box3> boxes, std::span<SignRange> out,
                std::span<std::shared_ptr<SampledField>> parts) override {
        if (has_narrowing())
            Narrowing::narrow(narrowing_, code_->tape(), boxes, out, parts);
        else
            SampledField::narrow(boxes, out, parts);
    }

    void narrow_signs(std::span<const Box3> boxes, std::span<std::shared_ptr<SampledField>> near) override {
        if (has_narrowing())
            Narrowing::narrow_signs(narrowing_, code_, boxes, near);
        else
            SampledField::narrow_signs(boxes, near);
    }

  private:
    /// Longer tapes are left to the evaluator, which bounds its memory.
    static constexpr std::size_t most_clauses = std::size_t{1} << 18;

    /// Makes the tape to be narrowed; false where there is none.
    bool has_narrowing() {
        if (!narrowing_ && evaluator_->clauses()) {
            code_ = std::make_shared<TapeCode>(shifted(*evaluator_->clauses(), iso_));
            narrowing_ = std::make_shared<Narrowing>(columns_.map());
        }
        return narrowing_ != nullptr;
    }

    std::unique_ptr<Evaluator> evaluator_;
    AxisColumns columns_;
    double iso_;
    std::shared_ptr<TapeCode> code_;  ///< of F - iso, once it was needed; so the next
    std::shared_ptr<Narrowing> narrowing_;
    std::vector<double> unused_;
    std::vector<double*> outputs_;
    std::vector<math::Interval> intervals_;
    std::vector<const math::Interval*> interval_inputs_;
};

bool is_finite(double v) { return v - v == 0; }

}  // namespace

void SampledField::narrow(std::span<const Box3> boxes, std::span<SignRange> out,
                          std::span<std::shared_ptr<SampledField>> parts) {
    ranges(boxes, out);
    for (std::shared_ptr<SampledField>& part : parts) part = nullptr;
}

void narrow_parts(SampledField& whole, std::span<FieldPart> parts, std::span<SignRange> ranges) {
    std::vector<Box3> boxes;
    std::vector<std::shared_ptr<SampledField>> narrowed;
    for (std::size_t first = 0, last = 0; first < parts.size(); first = last) {
        boxes.clear();
        for (last = first; last < parts.size() && parts[last].field == parts[first].field; ++last)
            boxes.push_back(parts[last].box);
        narrowed.assign(boxes.size(), nullptr);
        SampledField& field = parts[first].field ? *parts[first].field : whole;
        field.narrow(boxes, ranges.subspan(first, boxes.size()), narrowed);
        for (std::size_t n = 0; n < boxes.size(); ++n)
            if (narrowed[n]) parts[first + n].field = std::move(narrowed[n]);
    }
}

void SampledField::narrow_signs(std::span<const Box3>, std::span<std::shared_ptr<SampledField>> near) {
    for (std::shared_ptr<SampledField>& field : near) field = nullptr;
}

void narrow_signs(SampledField& whole, std::span<const FieldPart> parts,
                  std::span<std::shared_ptr<SampledField>> near) {
    std::vector<Box3> boxes;
    for (std::size_t first = 0, last = 0; first < parts.size(); first = last) {
        boxes.clear();
        for (last = first; last < parts.size() && parts[last].field == parts[first].field; ++last)
            boxes.push_back(parts[last].box);
        SampledField& field = parts[first].field ? *parts[first].field : whole;
        field.narrow_signs(boxes, near.subspan(first, boxes.size()));
    }
}

void SampledField::attributes(const PointSpans&, std::span<const std::span<double>> out) {
    FREP_CHECK(out.empty());
}

AxisMap AxisMap::standard(int count) {
    AxisMap map;
    for (int i = 0; i < count; ++i) map.coordinates.push_back({.axis = i < 3 ? i : -1, .value = 0});
    return map;
}

bool AxisMap::uses(int axis) const {
    for (const MappedCoordinate& c : coordinates) {
        if (c.axis == axis) return true;
    }
    return false;
}

Result<std::unique_ptr<SampledField>> make_sampled_field(std::unique_ptr<Evaluator> evaluator,
                                                         const AxisMap& map, double iso) {
    const auto fail = [](std::string message) {
        return Error{ErrorKind::invalid_argument, std::move(message)};
    };
    const auto entries = static_cast<int>(map.coordinates.size());
    if (entries != evaluator->coordinates()) {
        return fail(fmt::format("the map has {} entries for a model of {} coordinates", entries,
                                evaluator->coordinates()));
    }
    for (const MappedCoordinate& c : map.coordinates) {
        if (c.axis < -1 || c.axis > 2) return fail("the map names an axis other than x, y and z");
        if (!is_finite(c.value)) return fail("a frozen coordinate is not a finite number");
    }
    if (!is_finite(iso)) return fail("the iso value is not a finite number");
    return std::unique_ptr<SampledField>(std::make_unique<MappedField>(std::move(evaluator), map, iso));
}

}  // namespace frep
