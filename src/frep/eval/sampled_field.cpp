// The adaptor from eval's Evaluator to SampledField; see sampled_field.h.
#include "frep/eval/sampled_field.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace frep {

namespace {

class MappedField final : public SampledField {
  public:
    MappedField(std::unique_ptr<Evaluator> evaluator, AxisMap map, double iso)
        : evaluator_(std::move(evaluator)), map_(std::move(map)), iso_(iso) {}

    std::unique_ptr<SampledField> clone() const override {
        return std::make_unique<MappedField>(evaluator_->clone(), map_, iso_);
    }

    void values(const PointSpans& points, std::span<double> out) override {
        const std::size_t count = points.size();
        set_inputs(points);
        outputs_.assign(1, out.data());
        evaluator_->values(inputs_, count, outputs_);
        for (std::size_t p = 0; p < count; ++p) out[p] -= iso_;
    }

    void gradients(const PointSpans& points, std::span<double> values, const GradientSpans& out) override {
        const std::size_t count = points.size();
        set_inputs(points);
        partials_.resize(map_.coordinates.size() * count);
        outputs_.clear();
        for (std::size_t i = 0; i < map_.coordinates.size(); ++i) outputs_.push_back(&partials_[i * count]);
        evaluator_->gradients(inputs_, count, values.data(), outputs_);
        const std::array<std::span<double>, 3> axes{out.x, out.y, out.z};
        for (const std::span<double>& axis : axes) {
            for (double& d : axis) d = 0;
        }
        for (std::size_t i = 0; i < map_.coordinates.size(); ++i) {
            if (map_.coordinates[i].axis < 0) continue;
            const std::span<double>& axis = axes[static_cast<std::size_t>(map_.coordinates[i].axis)];
            for (std::size_t p = 0; p < count; ++p) axis[p] += outputs_[i][p];
        }
        for (std::size_t p = 0; p < count; ++p) values[p] -= iso_;
    }

    std::size_t attribute_count() const override {
        return static_cast<std::size_t>(evaluator_->outputs()) - 1;
    }

    void attributes(const PointSpans& points, std::span<const std::span<double>> out) override {
        FREP_CHECK(out.size() <= attribute_count());
        const std::size_t count = points.size();
        set_inputs(points);
        unused_.resize((attribute_count() + 1 - out.size()) * count);
        outputs_.assign(1, unused_.data());
        for (const std::span<double>& column : out) outputs_.push_back(column.data());
        for (std::size_t k = 1; outputs_.size() <= attribute_count(); ++k)
            outputs_.push_back(unused_.data() + k * count);
        evaluator_->values(inputs_, count, outputs_);
    }

    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        const std::size_t count = boxes.size();
        const std::size_t n = map_.coordinates.size();
        intervals_.resize((n + 1) * count);
        interval_inputs_.clear();
        for (std::size_t i = 0; i < n; ++i) {
            math::Interval* column = &intervals_[i * count];
            for (std::size_t b = 0; b < count; ++b) column[b] = side(boxes[b], map_.coordinates[i]);
            interval_inputs_.push_back(column);
        }
        math::Interval* result = intervals_.data() + n * count;
        evaluator_->intervals(interval_inputs_, count, result);
        for (std::size_t b = 0; b < count; ++b) {
            const math::Interval& f = result[b];
            out[b] = {f.hi >= iso_ && !f.is_empty(), f.lo < iso_ && !f.is_empty(), f.maybe_undefined};
        }
    }

  private:
    static math::Interval side(const Box3& box, const MappedCoordinate& source) {
        switch (source.axis) {
            case 0:
                return {box.min.x, box.max.x};
            case 1:
                return {box.min.y, box.max.y};
            case 2:
                return {box.min.z, box.max.z};
            default:
                return {source.value, source.value};
        }
    }

    void set_inputs(const PointSpans& points) {
        const std::size_t count = points.size();
        const std::array<const double*, 3> axes{points.x.data(), points.y.data(), points.z.data()};
        const std::size_t n = map_.coordinates.size();
        frozen_.resize(n * count);
        inputs_.clear();
        for (std::size_t i = 0; i < n; ++i) {
            const MappedCoordinate& source = map_.coordinates[i];
            if (source.axis >= 0) {
                inputs_.push_back(axes[static_cast<std::size_t>(source.axis)]);
                continue;
            }
            double* column = frozen_.data() + i * count;
            for (std::size_t p = 0; p < count; ++p) column[p] = source.value;
            inputs_.push_back(column);
        }
    }

    std::unique_ptr<Evaluator> evaluator_;
    AxisMap map_;
    double iso_;
    std::vector<double> frozen_, unused_, partials_;
    std::vector<const double*> inputs_;
    std::vector<double*> outputs_;
    std::vector<math::Interval> intervals_;
    std::vector<const math::Interval*> interval_inputs_;
};

bool is_finite(double v) { return v - v == 0; }

}  // namespace

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
