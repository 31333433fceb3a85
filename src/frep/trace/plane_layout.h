// Where the parts of a figure lie: the window, its ticks and captions, the color bar. Sizes follow the height
// of its letters. Tested through tests/unit/trace/plane_picture_test.cpp.
#pragma once

#include <string>

#include "frep/trace/plane_canvas.h"
#include "frep/trace/plane_levels.h"
#include "frep/trace/plane_picture.h"

namespace frep::drawing {

/// An axis: its ticks in model units and what is written.
struct Axis {
    Ticks ticks;
    Labels labels;
    std::string caption;  ///< with the common factor of the labels
};

struct Layout {
    int width = 0, height = 0;  ///< of the picture
    double letter = 11;         ///< height of a capital letter, pixels
    PixelBox plot;              ///< whole pixels
    Window window;              ///< what the plot shows
    Axis right, up;
    PixelBox bar;           ///< the color bar without its pointed ends
    double point = 0;       ///< height of a pointed end
    PixelBox swatch;        ///< sample of the hatching; empty if nothing is undefined
    double bar_labels = 0;  ///< where the numbers beside the bar begin
};

/// What the color bar must hold, which is known before the values are: room for labels of this width.
inline constexpr double bar_label_letters = 6.4;

/// Errors: as field_picture().
Result<Layout> make_layout(const FieldPictureOptions& options);

/// Moves the foot of the bar up to make room for the sample of the hatching.
void add_swatch(Layout& layout);

/// Takes away what a picture without a stated size has to the right of `label_width` pixels of labels.
void trim(Layout& layout, double label_width);

}  // namespace frep::drawing
