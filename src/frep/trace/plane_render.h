// render_plane: the picture of a 2-D shape, or of a plane section of a solid: filled, with sharp and evenly
// anti-aliased outlines. Parts that intervals prove to be inside or outside are filled at once; where the
// function's sign changes within a pixel, 64 samples decide how much of it is covered. Colors are mixed as
// linear light. The same bytes for every number of threads.
// Tested by tests/unit/trace/plane_render_test.cpp.
#pragma once

#include <cstdint>
#include <optional>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/sampled_field.h"
#include "frep/geom/color.h"
#include "frep/geom/image.h"
#include "frep/trace/plane_window.h"

namespace frep {

struct PlaneRenderOptions {
    Plane plane;
    Rectangle part{{-10, -10}, {10, 10}};  ///< of the plane, shown as a whole
    double margin = 0.04;                  ///< around it, a share of the picture's sides, 0 to below 1/2
    int width = 800, height = 800;         ///< pixels
    Color color{0.78, 0.76, 0.72};         ///< of the shape
    bool attribute_colors =
        false;  ///< R, G, B from the field's first three attributes, where they are defined
    std::optional<Color> background = Color{1, 1, 1};  ///< nothing: transparent
    bool prune = true;  ///< use intervals; without them the picture is the same, slower, and very thin parts
                        ///< may be missed in either case
};

struct PlaneRender {
    Image image;
    Window window;                ///< of the whole picture
    double area = 0;              ///< covered part, model units squared
    std::uint64_t undefined = 0;  ///< of the samples of a regular lattice, those where F is undefined
    std::uint64_t sampled = 0;    ///< points where F was evaluated
};

/// Errors: invalid_argument for sizes that are not 1..16384, a part that is empty or too small (see
/// Window::around), a margin out of range, or attribute colors of a field with fewer than three attributes;
/// cancelled.
Result<PlaneRender> render_plane(const SampledField& field, const PlaneRenderOptions& options,
                                 const Job& job);

}  // namespace frep
