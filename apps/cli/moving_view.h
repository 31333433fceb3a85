// Pictures of a model in several of its states, with one box and one look for all: the frames of an animation
// and the views of a matrix. Tested by tests/cli/animate.txt and render_matrix.txt.
#pragma once

#include <optional>

#include "model_input.h"
#include "render_options.h"

namespace frep::cli {

class MovingView {
  public:
    /// `options` and `prepared` must outlive the view.
    MovingView(const RenderOptionTexts& options, RenderPlan plan, PreparedModel& prepared);

    /// Takes the model's own wishes for its look. Gives an exit code when an option means nothing for a plane
    /// shape, which is then printed.
    std::optional<int> begin();
    /// Widens the box by what choose_box() finds for the present state of the model. Errors: as there.
    Status include();
    /// The model is in another state now.
    void changed() { scene_.reset(); }
    /// The present state, the camera turned by so many degrees. Errors: as of the picture's maker.
    Result<Image> picture(double turn = 0);

    /// True for a shape of the plane.
    bool is_flat() const { return flat_axis_.has_value(); }
    const Box3& box() const { return *box_; }
    /// The box, without extent across a plane shape.
    Box3 measured_box() const;

  private:
    Result<Image> flat_picture_now();
    Result<Image> solid_picture_now(double turn);

    const RenderOptionTexts& options_;
    RenderPlan plan_;
    PreparedModel& prepared_;
    NamedMaterial finish_{};
    Job job_;
    std::optional<int> flat_axis_;
    std::optional<Box3> box_;
    std::optional<SolidScene> scene_;
};

}  // namespace frep::cli
