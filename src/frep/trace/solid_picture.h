// Pictures of solids: rays against the function itself, not against a mesh, in a photographer's studio.
// Distances and cells are found once for a scene (distance_grid.h); every picture of it then traces one ray a
// pixel (first_hit.h) and more where neighbours differ, lights the points (shading.h) and puts them before
// the backdrop. The bytes do not depend on the number of threads or on the machine.
// Tested by tests/unit/trace/solid_picture_test.cpp.
#pragma once

#include <memory>
#include <optional>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/sampled_field.h"
#include "frep/geom/image.h"
#include "frep/trace/camera.h"
#include "frep/trace/materials.h"

namespace frep {

enum class Backdrop { studio, plain, transparent };
enum class PictureQuality { draft, normal, high };

/// A half-space that is cut away: beyond or before `value` on an axis.
struct Section {
    int axis = 2;  ///< 0, 1, 2
    double value = 0;
    bool keeps_less = true;  ///< what lies below `value` stays
};
/// A section whose cut away half is that towards the viewer.
Section section_towards(const View& view, int axis, double value);

/// What belongs to the solid and not to the camera.
struct SceneOptions {
    Box3 bounds;  ///< the solid is shown within this box
    std::optional<Section> section;
    PictureQuality quality = PictureQuality::normal;
    int longest_side = 1200;  ///< pixels of the pictures to come; small ones need less preparation
};

struct PictureOptions {
    static constexpr int most_side = 16384;
    static constexpr std::int64_t most_pixels = std::int64_t{1} << 26;

    int width = 1200, height = 900;  ///< 1..most_side, most_pixels in all
    View view;
    /// Turns of the object that must fit, too: the picture is framed for all azimuths. For turntables.
    bool framed_all_round = false;
    /// The box that must fit, in place of the solid, and on whose bottom the table is: for pictures of one
    /// animation, whose camera stands still.
    std::optional<Box3> stage;
    const NamedMaterial* material = nullptr;  ///< the first of the table if null
    std::optional<Color> color;               ///< in place of the material's own
    Color section_color{0.86, 0.79, 0.66};
    Backdrop backdrop = Backdrop::studio;
    Color backdrop_color{1, 1, 1};  ///< of Backdrop::plain
    bool ground = true;             ///< the object stands on a table and casts shadows
};

class SolidScene {
  public:
    /// `field` with the first attribute_count() of 3 or more as its color, for materials that use them. The
    /// scene keeps a clone. Errors: invalid_argument for a box without volume or a section outside of it,
    /// cancelled.
    static Result<SolidScene> make(const SampledField& field, const SceneOptions& options, const Job& job);
    SolidScene(SolidScene&&) noexcept;
    ~SolidScene();

    /// False when there is surely nothing in the box.
    bool has_solid() const;
    /// True when intervals say nothing about the function, or in a draft take too long
    /// (SampledField::has_dear_ranges): samples half a cell apart find the surface then, and details below a
    /// cell may be missed.
    bool sampled() const;

    /// A picture of the scene. Errors: invalid_argument for a size or an angle out of range, cancelled.
    Result<Image> picture(const PictureOptions& options, const Job& job) const;

  private:
    struct Parts;
    explicit SolidScene(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

/// SolidScene::make() and picture() in one.
Result<Image> render_solid(const SampledField& field, const SceneOptions& scene,
                           const PictureOptions& options, const Job& job);

}  // namespace frep
