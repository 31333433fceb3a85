// Implementation of plane_colors.h; the matrices are those of Ottosson's article.
#include "frep/trace/plane_colors.h"

#include <algorithm>
#include <cmath>

#include "frep/math/functions.h"

namespace frep::drawing {

namespace {

constexpr double degree = 0x1.1df46a2529d39p-6;  // pi / 180
constexpr double inside_hue = 58 * degree, outside_hue = 252 * degree;

double cube_root(double v) { return v > 0 ? math::pow(v, 1.0 / 3.0) : 0; }

}  // namespace

Color color_from_oklab(double lightness, double a, double b) {
    const double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
    const double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
    const double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
    const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
    return srgb_from_linear({4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
                             -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
                             -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3});
}

double oklab_lightness(const Color& color) {
    const Color c = linear_from_srgb(color);
    const double l = cube_root(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
    const double m = cube_root(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
    const double s = cube_root(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
    return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

Color diverging_color(double t) {
    const double size = std::min(std::fabs(t), 1.0);
    const double lightness = 0.965 - 0.505 * size;
    const double chroma = 0.018 + 0.107 * size * (2 - size);
    const double hue = t > 0 ? inside_hue : outside_hue;
    return color_from_oklab(lightness, chroma * math::cos(hue), chroma * math::sin(hue));
}

std::vector<Color> band_colors(std::span<const double> levels) {
    const double first = levels.front(), last = levels.back();
    const std::size_t count = levels.size();
    double largest = std::max(std::fabs(first), std::fabs(last));
    if (!(largest > 0)) largest = 1;
    // The open bands at both ends reach as far beyond as their neighbours are wide.
    const double low_step = count > 1 ? levels[1] - first : largest;
    const double high_step = count > 1 ? last - levels[count - 2] : largest;
    std::vector<Color> out;
    for (std::size_t i = 0; i <= count; ++i) {
        const double low = i == 0 ? first - low_step : levels[i - 1];
        const double high = i == count ? last + high_step : levels[i];
        out.push_back(diverging_color((low / 2 + high / 2) / largest));
    }
    return out;
}

std::size_t band_of(std::span<const double> levels, double value) {
    return static_cast<std::size_t>(std::upper_bound(levels.begin(), levels.end(), value) - levels.begin());
}

}  // namespace frep::drawing
