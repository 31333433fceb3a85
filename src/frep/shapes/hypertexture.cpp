// Hypertexture and its row. See hypertexture.h.
#include "frep/shapes/hypertexture.h"

#include <fmt/format.h>

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

constexpr int most_octaves = 12;
constexpr double offset[3] = {0.31, 0.57, 0.83};

/// 1 at f = 0, falling to 0 at |f| = falloff with two derivatives.
Expression near_surface(Expression f, Expression falloff) {
    const Expression rest = max(1.0 - square(f / falloff), 0.0);
    return rest * square(rest);
}

}  // namespace

Expression hypertexture(Build& build, Array x, Expression f, Expression amplitude, Expression frequency,
                        Expression octaves, Expression falloff) {
    if (x.size() != 3) return build.error("x must have 3 items");
    const auto number = known(build, octaves);
    if (!number || !(*number >= 0.5) || !(*number < most_octaves + 0.5))
        return build.error(fmt::format("octaves must be a known whole number of 1..{}", most_octaves));
    const int count = static_cast<int>(*number + 0.5);
    Expression noise = build.constant(0);
    double scale = 1;
    for (int k = 0; k < count; ++k, scale *= 2) {
        Expression place[3];
        for (std::size_t i = 0; i < 3; ++i) place[i] = frequency * scale * x[i] + k * offset[i];
        noise = noise + apply(Op::lattice_noise, {place[0], place[1], place[2]}) / scale;
    }
    const auto reach = build.graph.constant_value(falloff.id());
    if (reach && !(*reach > 0)) return f + amplitude * noise;
    const Expression weight =
        reach ? near_surface(f, falloff)
              : select(less_equal(falloff, 0.0), build.constant(1), near_surface(f, falloff));
    return f + amplitude * weight * noise;
}

Rows hypertexture_rows() {
    return {
        row<&hypertexture>(
            "hfHypertexture", "x, f, amplitude, frequency, octaves, falloff",
            {"Hypertexture: the solid f with fractal noise added, everywhere or near its surface only.",
             "f + amplitude w sum over k < octaves of hfA_NoiseP(2^k frequency x + k (0.31, 0.57, "
             "0.83))/2^k; "
             "w = (1 - (f/falloff)^2)^3 for |f| < falloff, else 0",
             "perlin1989",
             "A falloff of 0 means w = 1. With a falloff no crumbs arise farther than where |f| = falloff, "
             "and "
             "pictures are faster. Frequencies are lattice cells a unit."},
            false),
    };
}

}  // namespace frep::shapes
