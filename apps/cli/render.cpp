// `frep render`: pictures of a solid; shapes of the plane go to render_flat.h. Tested by tests/cli/render.txt
// and render_usage.txt.
#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "box.h"
#include "color_by.h"
#include "command_line.h"
#include "picture_file.h"
#include "render_flat.h"
#include "render_matrix.h"
#include "render_options.h"
#include "terminal.h"
#include "verbs.h"

namespace frep::cli {

namespace {

class RenderRun {
  public:
    RenderRun(const RenderOptionTexts& options, RenderPlan plan, const PreparedModel& prepared)
        : options_(options), plan_(std::move(plan)), prepared_(prepared), start_(now_seconds()) {
        job_.threads = prepared.threads;
    }

    int run() {
        take_wishes(options_, prepared_, plan_, finish_);
        const auto sampled = sampled_field(prepared_, plan_.iso, plan_.picture.material->uses_attributes);
        if (!sampled) return fail(sampled.error());
        SceneOptions options;
        options.quality = plan_.quality;
        options.longest_side = std::max(plan_.picture.width, plan_.picture.height);
        const auto box = choose_box(prepared_, plan_.bounds, **sampled, job_);
        if (!box) return fail(box.error());
        options.bounds = *box;
        if (plan_.section)
            options.section =
                section_towards(plan_.picture.view, plan_.section->first, plan_.section->second);
        ProgressBar bar("rendering");
        const auto scene = SolidScene::make(**sampled, options, job_);
        if (!scene) return fail(scene.error());
        warn(*scene);
        return plan_.turntable > 0 ? turn(*scene, bar) : single(*scene, bar);
    }

  private:
    static void warn(const SolidScene& scene) {
        if (!scene.has_solid()) print_warning("there is nothing to see: the solid is empty in the box");
        if (scene.sampled())
            print_warning(
                "intervals say nothing about this function or take too long, so the surface was looked for "
                "at samples: "
                "details finer than a hundredth of the box may be missed");
    }

    int single(const SolidScene& scene, ProgressBar& bar) {
        job_.on_progress = [&bar](double share) { bar.update(share); };
        const auto image = scene.picture(plan_.picture, job_);
        job_.on_progress = nullptr;
        if (!image) return fail(image.error());
        if (const int code = write_picture(*image, prepared_.model, *options_.output)) return code;
        summarize(*options_.output);
        return exit_ok;
    }

    int turn(const SolidScene& scene, ProgressBar& bar) {
        const std::filesystem::path path(*options_.output);
        const double first = plan_.picture.view.azimuth;
        for (int n = 0; n < plan_.turntable; ++n) {
            PictureOptions picture = plan_.picture;
            picture.view.azimuth = first + 360.0 * n / plan_.turntable;
            const auto image = scene.picture(picture, job_);
            if (!image) return fail(image.error());
            bar.update(static_cast<double>(n + 1) / plan_.turntable);
            const std::string name = fmt::format("{}-{:03}.png", path.stem().string(), n + 1);
            if (const int code = write_picture(*image, prepared_.model, (path.parent_path() / name).string()))
                return code;
        }
        summarize(fmt::format("{} files beside {}", plan_.turntable, *options_.output));
        return exit_ok;
    }

    void summarize(const std::string& where) const {
        print_summary(fmt::format("{} x {} pixels to {} in {:.2f} s", plan_.picture.width,
                                  plan_.picture.height, where == "-" ? "standard output" : where,
                                  now_seconds() - start_));
    }

    const RenderOptionTexts& options_;
    RenderPlan plan_;
    const PreparedModel& prepared_;
    NamedMaterial finish_{};
    Job job_;
    double start_;
};

}  // namespace

int run_render(Arguments arguments) {
    RenderOptionTexts options;
    CommandLine line(
        "render", "render MODEL -o FILE.png [options]",
        "Makes a picture of a solid (rays against the function itself) or of a plane shape.",
        {"frep render pot.hf -o pot.png", "frep render pot.hf -o pot.png --material lacquer --view iso",
         "frep render morph.hf -o steps.png --matrix t=-10:10:5"});
    declare_render_options(line, options);
    if (const auto code = line.parse(arguments)) return *code;
    auto plan = plan_render(options);
    if (!plan) return fail(plan.error());
    int code = exit_ok;
    auto prepared = prepare_model(options.model, code);
    if (!prepared) return code;
    if (const Status status = take_color_by(options, *prepared); !status) return fail(status.error());
    if (options.matrix) {
        if (options.turntable) return usage_error("--matrix and --turntable exclude each other");
        const auto matrix = parse_matrix(*options.matrix);
        if (!matrix) return usage_error("--matrix: " + matrix.error().message);
        if (!options.size) {
            plan->picture.width = 480;
            plan->picture.height = 360;
        }
        return render_matrix(options, *plan, *matrix, *prepared);
    }
    if (unused_axis(*prepared)) return render_flat(options, *plan, *prepared);
    return RenderRun(options, std::move(*plan), *prepared).run();
}

}  // namespace frep::cli
