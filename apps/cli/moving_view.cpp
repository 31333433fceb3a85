// Implementation of moving_view.h.
#include "moving_view.h"

#include <algorithm>
#include <utility>

#include "box.h"
#include "render_flat.h"

namespace frep::cli {

MovingView::MovingView(const RenderOptionTexts& options, RenderPlan plan, PreparedModel& prepared)
    : options_(options), plan_(std::move(plan)), prepared_(prepared), flat_axis_(unused_axis(prepared)) {
    job_.threads = prepared.threads;
}

std::optional<int> MovingView::begin() {
    if (flat_axis_) return refuse_flat(options_, prepared_);
    take_wishes(options_, prepared_, plan_, finish_);
    return std::nullopt;
}

Status MovingView::include() {
    const auto field = sampled_field(prepared_, plan_.iso, false);
    if (!field) return field.error();
    const auto box = choose_box(prepared_, plan_.bounds, **field, job_);
    if (!box) return box.error();
    box_ = box_ ? joined(*box_, *box) : *box;
    return {};
}

Box3 MovingView::measured_box() const {
    Box3 out = *box_;
    double Vec3::*const axes[3] = {&Vec3::x, &Vec3::y, &Vec3::z};
    if (flat_axis_) out.min.*axes[*flat_axis_] = out.max.*axes[*flat_axis_] = 0;
    return out;
}

Result<Image> MovingView::picture(double turn) {
    return flat_axis_ ? flat_picture_now() : solid_picture_now(turn);
}

Result<Image> MovingView::flat_picture_now() {
    const PlaneRenderOptions picture = flat_picture(options_, plan_, prepared_, *box_, plan_.picture.width);
    const auto field = sampled_field(prepared_, plan_.iso, picture.attribute_colors);
    if (!field) return field.error();
    auto result = render_plane(**field, picture, job_);
    if (!result) return result.error();
    return std::move(result->image);
}

Result<Image> MovingView::solid_picture_now(double turn) {
    PictureOptions picture = plan_.picture;
    picture.view.azimuth += turn;
    picture.stage = *box_;
    if (!scene_) {
        const auto field = sampled_field(prepared_, plan_.iso, picture.material->uses_attributes);
        if (!field) return field.error();
        SceneOptions options;
        options.bounds = *box_;
        options.quality = plan_.quality;
        options.longest_side = std::max(picture.width, picture.height);
        if (plan_.section)
            options.section =
                section_towards(plan_.picture.view, plan_.section->first, plan_.section->second);
        auto scene = SolidScene::make(**field, options, job_);
        if (!scene) return scene.error();
        scene_.emplace(std::move(*scene));
    }
    return scene_->picture(picture, job_);
}

}  // namespace frep::cli
