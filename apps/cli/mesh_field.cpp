// Implementation of mesh_field.h.
#include "mesh_field.h"

#include <fmt/format.h>

#include "box.h"
#include "terminal.h"

namespace frep::cli {

namespace {

/// Values from a field without attributes, attributes from the whole field: contouring samples F far more
/// often than colors.
class SplitField final : public SampledField {
  public:
    SplitField(std::unique_ptr<SampledField> shape, std::unique_ptr<SampledField> whole)
        : shape_(std::move(shape)), whole_(std::move(whole)) {}

    std::unique_ptr<SampledField> clone() const override {
        return std::make_unique<SplitField>(shape_->clone(), whole_->clone());
    }
    void values(const PointSpans& points, std::span<double> out) override { shape_->values(points, out); }
    void gradients(const PointSpans& points, std::span<double> values, const GradientSpans& out) override {
        shape_->gradients(points, values, out);
    }
    std::size_t attribute_count() const override { return whole_->attribute_count(); }
    void attributes(const PointSpans& points, std::span<const std::span<double>> out) override {
        whole_->attributes(points, out);
    }
    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        shape_->ranges(boxes, out);
    }

  private:
    std::unique_ptr<SampledField> shape_, whole_;
};

Result<std::unique_ptr<SampledField>> sampled(const PreparedModel& prepared, double iso, bool attributes) {
    EvaluatorOptions options = prepared.evaluator;
    options.attributes = attributes;
    auto evaluator = make_evaluator(prepared.field(), options);
    if (!evaluator) return evaluator.error();
    return make_sampled_field(std::move(*evaluator), prepared.map, iso);
}

}  // namespace

Result<std::unique_ptr<SampledField>> mesh_field(const PreparedModel& prepared, double iso, bool colors) {
    auto plain = sampled(prepared, iso, false);
    if (!plain || !colors) return plain;
    auto whole = sampled(prepared, iso, true);
    if (!whole) return whole.error();
    return std::unique_ptr<SampledField>(std::make_unique<SplitField>(std::move(*plain), std::move(*whole)));
}

bool has_colors(const PreparedModel& prepared) {
    return prepared.header().declares_attributes && prepared.field().attributes.size() >= 3;
}

Color base_color(const PreparedModel& prepared) {
    const std::vector<double>& color = prepared.model.program().annotations.color;
    return color.size() == 3 ? Color{color[0], color[1], color[2]} : Material{}.base;
}

LengthUnit model_unit(const PreparedModel& prepared) {
    constexpr LengthUnit millimetre{"mm", 0.001};
    const std::string& text = prepared.model.program().annotations.units;
    if (text.empty()) return millimetre;
    if (const auto unit = length_unit(text)) return *unit;
    print_warning(
        fmt::format("--@ units: `{}` is not one of um, mm, cm, m, inch, ft; millimetres are assumed", text));
    return millimetre;
}

void warn_samples(const PreparedModel& prepared, std::uint64_t undefined, const std::optional<Vec3>& first) {
    if (undefined == 0 || !first) return;
    const double axes[3] = {first->x, first->y, first->z};
    std::vector<double> point;
    for (const MappedCoordinate& c : prepared.map.coordinates)
        point.push_back(c.axis < 0 ? c.value : axes[c.axis]);
    warn_undefined(prepared, prepared.field().value, point,
                   fmt::format("F is undefined at {} sample points, which count as outside; the first is {}",
                               undefined, point_text(point)));
}

void warn_touches(const std::array<bool, 6>& touches, bool cap, std::string_view what) {
    const std::string sides = side_list(touches);
    if (sides.empty()) return;
    const std::string_view consequence = cap ? "capped there" : "open there (--cap closes it)";
    print_warning(fmt::format("the surface touches the box at {}: the {} {}", sides, what, consequence));
}

}  // namespace frep::cli
