// Implementation of mesh_model.h.
#include "mesh_model.h"

#include <fmt/format.h>

#include "box.h"
#include "terminal.h"

namespace frep::cli {

Color base_color(const PreparedModel& prepared) {
    return annotated_color(prepared.model).value_or(Material{}.base);
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
