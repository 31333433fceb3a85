// The options of `frep render`, as given and as understood. Tested by tests/cli/render_usage.txt.
#pragma once

#include <optional>
#include <string>

#include "model_input.h"
#include "values.h"

namespace frep::cli {

struct RenderOptionTexts {
    ModelOptions model;
    std::optional<std::string> output, size, view, azimuth, elevation, perspective, zoom, material,
        base_color, section, section_color, background, bounds, iso, quality, turntable, matrix, color_by;
    bool ortho = false, no_ground = false;
};
void declare_render_options(CommandLine& line, RenderOptionTexts& options);
/// Those of the model, the camera and the look: all but the output, the turntable and the matrix.
void declare_look_options(CommandLine& line, RenderOptionTexts& options);

/// What they mean; the model's own wishes (`--@ material`, `--@ view`, `--@ color`) count where the command
/// line is silent.
struct RenderPlan {
    PictureOptions picture;
    PictureQuality quality = PictureQuality::normal;
    std::optional<StatedBounds> bounds;
    double iso = 0;
    std::optional<std::pair<int, double>> section;  ///< axis and value
    int turntable = 0;                              ///< pictures of a turn; 0: one picture
    bool has_azimuth = false, has_elevation = false;
};

/// Errors: invalid_argument, io for a folder of an output file that is not there.
Result<RenderPlan> plan_render(const RenderOptionTexts& options);
/// The same without the output and the turntable.
Result<RenderPlan> plan_look(const RenderOptionTexts& options);

/// Fills in what the model itself wishes (`--@ material`, `--@ view`, `--@ color`, its colors) where the
/// command line is silent, with a warning for wishes that mean nothing. `finish` keeps a material that is
/// made here and must live as long as the plan.
void take_wishes(const RenderOptionTexts& options, const PreparedModel& prepared, RenderPlan& plan,
                 NamedMaterial& finish);

/// `#rrggbb` or `#rgb`.
Result<Color> parse_color(std::string_view text);
/// An angle in degrees: `30`, `30deg`.
Result<double> parse_angle(std::string_view text);
/// `800x600`, or `800` for a square.
Result<std::pair<int, int>> parse_size_pixels(std::string_view text);

}  // namespace frep::cli
