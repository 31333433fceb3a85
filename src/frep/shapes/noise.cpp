// Solid noise and its rows. See noise.h.
#include "frep/shapes/noise.h"

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {
constexpr const char* needs_x = "x must have 3 items";
}

Expression gardner_series(Expression x, Expression y, Expression z, Expression amp, Expression freq,
                          Expression phase) {
    const Expression sx = sin(freq * x), sy = sin(freq * y), sz = sin(freq * z);
    const Expression second = amp / 1.17;
    const auto series = [&](Expression u, Expression s, Expression modulation) {
        return amp * s + second * sin(freq * u / 1.35 + phase * modulation);
    };
    return series(x, sx, sz) * series(y, sy, sx) * series(z, sz, sy);
}

Expression gardner(Build& build, Array x, Expression amp, Expression freq, Expression phase) {
    if (x.size() != 3) return build.error(needs_x);
    return gardner_series(x[0], x[1], x[2], amp, freq, phase);
}

Expression gardner_unit(Build& build, Array x, Expression freq, Expression phase) {
    if (x.size() != 3) return build.error(needs_x);
    const Expression g = gardner_series(x[0], x[1], x[2], build.constant(1.0), freq, phase);
    return (g + gardner_bound) / (2.0 * gardner_bound);
}

Expression lattice_noise(Build& build, Array x) {
    if (x.size() != 3) return build.error(needs_x);
    return apply(Op::lattice_noise, {x[0], x[1], x[2]});
}

Expression turbulence(Build& build, Array x, Expression freq) {
    if (x.size() != 3) return build.error(needs_x);
    return apply(Op::turbulence, {x[0], x[1], x[2], freq});
}

Rows noise_rows() {
    return {
        row<&gardner>("hfNoiseG", "x, amp, freq, phase",
                      {"Gardner's solid noise, to be added to a solid; try 2.5, 0.7, 1.4.",
                       "G1 G2 G3; S_k = sin(freq x_k); G1 = amp S1 + amp/1.17 sin(freq x1/1.35 + phase S3); "
                       "G2 with x2 and S2, S1; G3 with x3 and S3, S2",
                       "gardner1984"}),
        row<&gardner_unit>("hfA_NoiseG", "x, freq, phase",
                           {"Gardner's noise of amplitude 1 mapped to 0..1.",
                            "(hfNoiseG(x, 1, freq, phase) + k)/(2 k), k = (2.17/1.17)^3", "gardner1984"}),
        row<&lattice_noise>("hfA_NoiseP", "x",
                            {"Lattice noise: 0 at points of whole coordinates, smooth between.",
                             "interpolated products of pseudo-random unit gradients with lattice offsets",
                             "perlin1985", "One fixed table; the old tools drew another one in every run."}),
        row<&turbulence>("hfA_Turbulence", "x, freq",
                         {"Turbulence: octaves of lattice noise.",
                          "sum over f = freq, freq/2, ... while f >= 1 of |2 hfA_NoiseP(f x) - 1|/f",
                          "perlin1985", "One fixed table; the old tools drew another one in every run."}),
    };
}

}  // namespace frep::shapes
