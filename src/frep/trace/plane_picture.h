// field_picture: what a function does in a plane, as a figure: bands of color between round levels, thin
// lines at the levels, a bold line where F = 0, axes in model units, a color bar with numbers. Where F is
// undefined the figure is hatched in grey. The zero line is found by bisection of the function itself, to
// better than 1/100 pixel. The same bytes for every number of threads. Tested by
// tests/unit/trace/plane_picture_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/sampled_field.h"
#include "frep/geom/image.h"
#include "frep/trace/plane_window.h"

namespace frep {

struct FieldPictureOptions {
    Plane plane;
    Rectangle part{{-10, -10},
                   {10, 10}};  ///< of the plane, shown as a whole; more of it where it is very long
    /// Size of the picture in pixels; 0: from the shape of the part, about 900 along the longer side.
    int width = 0, height = 0;
    int level_count = 12;             ///< about so many levels
    std::vector<double> levels;       ///< the levels, in place of a number of them
    std::string title;                ///< above the figure, UTF-8
    std::string right_name, up_name;  ///< captions of the axes, for instance "x, mm"
    std::string value_name = "F";     ///< caption of the color bar
};

struct FieldPicture {
    Image image;
    std::vector<double> levels;
    std::uint64_t samples = 0, undefined = 0;  ///< points where F was looked at; of them without a value
    double lowest = 0, highest = 0;            ///< values found; both 0 if all are undefined
    Window window;                             ///< the pixels of the figure's middle part
    int left = 0, top = 0;                     ///< the pixel of the picture where the window begins
};

/// True if the letters of figures suffice for a text; others are drawn as boxes.
bool can_draw_text(std::string_view utf8);

/// The least size of a picture with axes and color bar.
inline constexpr int least_figure_width = 240, least_figure_height = 160;
/// The greatest side of a picture.
inline constexpr int greatest_picture_side = 16384;

/// Errors: invalid_argument for a size out of range, levels that are not finite or more than 1000, or a part
/// that is empty or too small (see Window::around); cancelled.
Result<FieldPicture> field_picture(const SampledField& field, const FieldPictureOptions& options,
                                   const Job& job);

}  // namespace frep
