// `frep animate`: a model that changes along a coordinate or a parameter, or turns, as a moving picture.
// Finished frames are kept in a folder until the last one is done, so that a run can be interrupted. Tested
// by tests/cli/animate.txt.
#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "animate_options.h"
#include "budget.h"
#include "color_by.h"
#include "command_line.h"
#include "frame_report.h"
#include "frame_store.h"
#include "moving_view.h"
#include "terminal.h"
#include "verbs.h"

namespace frep::cli {

namespace {

constexpr int report_cells_flat = 256, report_cells_solid = 64;
/// Measures a frame, for an even rate of change.
constexpr int fine_steps = 4;
/// Values at which the box of a model without stated bounds is looked for.
constexpr int box_values = 9;

class AnimateRun {
  public:
    AnimateRun(const AnimateOptionTexts& options, AnimatePlan plan, PreparedModel& prepared,
               MovingModel model)
        : options_(options),
          plan_(std::move(plan)),
          prepared_(prepared),
          model_(std::move(model)),
          view_(options.look, plan_.look, prepared) {
        job_.threads = prepared.threads;
    }

    int run() {
        if (view_.is_flat() && options_.turntable)
            return usage_error("--turntable is for solids; this object is 2-D");
        if (const auto code = view_.begin()) return *code;
        values_ = values_of(plan_.frames);
        if (const Status status = find_box(); !status) return fail(status.error());
        if (const int code = measure()) return code;
        auto store = FrameStore::open(*options_.look.output, key());
        if (!store) return fail(store.error());
        if (const int code = make_frames(*store)) return code;
        if (const Status status =
                write_movie(*store, order(), *options_.look.output, plan_.kind, plan_.movie);
            !status)
            return fail(status.error());
        if (!options_.keep) store->remove(plan_.frames);
        print_summary(fmt::format("{} frames to {} in {:.2f} s", plan_.frames, *options_.look.output,
                                  now_seconds() - start_));
        return exit_ok;
    }

  private:
    /// The values of the frames; all 0 where nothing but the camera moves. A turn does not come back to its
    /// first frame.
    std::vector<double> values_of(int count) const {
        if (plan_.along) return evenly_spaced(*plan_.along, count);
        return std::vector<double>(static_cast<std::size_t>(count), 0);
    }

    /// One box for all frames.
    Status find_box() {
        const int count = plan_.along ? box_values : 1;
        for (int i = 0; i < count; ++i) {
            const std::size_t at =
                values_.size() > 1 && count > 1
                    ? (values_.size() - 1) * static_cast<std::size_t>(i) / static_cast<std::size_t>(count - 1)
                    : 0;
            if (const Status status = model_.set(values_[at]); !status) return status;
            if (const Status status = view_.include(); !status) return status;
        }
        return {};
    }

    /// Chooses even values, writes the report, warns.
    int measure() {
        if (!plan_.along || (!options_.even && !options_.report)) return exit_ok;
        const int cells = view_.is_flat() ? report_cells_flat : report_cells_solid;
        ProgressBar bar("measuring");
        job_.on_progress = [&bar](double share) { bar.update(share); };
        if (options_.even) {
            const auto fine = measure_frames(model_, values_of(fine_steps * plan_.frames + 1),
                                             view_.measured_box(), plan_.look.iso, cells, job_);
            if (!fine) return fail(fine.error());
            values_ = even_values(*fine, plan_.frames);
        }
        if (options_.report) {
            const auto frames =
                measure_frames(model_, values_, view_.measured_box(), plan_.look.iso, cells, job_);
            if (!frames) return fail(frames.error());
            warn_about_frames(*frames, model_.name());
            const std::string bytes = json_bytes(frame_report(*frames, model_.name(), view_.is_flat()));
            if (*options_.report == "-") {
                if (const int code = print_result(bytes)) return code;
            } else {
                const WritingFile guard;
                if (const Status status = write_file(*options_.report, bytes); !status)
                    return fail(status.error());
            }
        }
        job_.on_progress = nullptr;
        return exit_ok;
    }

    /// All that decides what a frame shows.
    std::string key() const {
        std::string out = fmt::format("frep {} frames {}\n", version(), plan_.frames);
        for (const double v : values_) out += number_text(v) + "\n";
        const Box3& box = view_.box();
        for (const double v : {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z})
            out += number_text(v) + " ";
        out += look_key();
        return out + "\n" + std::string(prepared_.model.source().text());
    }

    /// The options that change a picture; not the output, the report, the number of threads.
    std::string look_key() const {
        const RenderOptionTexts& o = options_.look;
        std::string out =
            fmt::format("\n{} {} {} {}", options_.turntable, o.ortho, o.no_ground, o.model.no_lift);
        for (const auto* text :
             {&o.size, &o.view, &o.azimuth, &o.elevation, &o.perspective, &o.zoom, &o.material, &o.base_color,
              &o.color_by, &o.section, &o.section_color, &o.background, &o.bounds, &o.iso, &o.quality,
              &o.model.object, &o.model.values, &o.model.map, &o.model.max_steps})
            out += "\n" + text->value_or("");
        for (const std::string& text : o.model.named_values) out += "\n" + text;
        return out + "\n" + model_.name();
    }

    int make_frames(const FrameStore& store) {
        ProgressBar bar("animating");
        const double begin = now_seconds();
        int made = 0;
        for (int i = 0; i < plan_.frames; ++i) {
            if (store.has(i)) continue;
            const auto image = frame(i);
            if (!image) return fail(image.error());
            if (const Status status = store.put(i, *image); !status) return fail(status.error());
            ++made;
            const double left = (now_seconds() - begin) / made * (plan_.frames - 1 - i);
            bar.update(static_cast<double>(i + 1) / plan_.frames, left);
        }
        if (made < plan_.frames)
            print_note(fmt::format("{} finished frames were there already", plan_.frames - made));
        return exit_ok;
    }

    Result<Image> frame(int i) {
        if (const Status status = model_.set(values_[static_cast<std::size_t>(i)]); !status)
            return status.error();
        if (plan_.along) view_.changed();
        return view_.picture(options_.turntable ? 360.0 * i / plan_.frames : 0);
    }

    /// The frames as they are shown; backwards without the two ends, which would stand still.
    std::vector<int> order() const {
        std::vector<int> out(static_cast<std::size_t>(plan_.frames));
        std::iota(out.begin(), out.end(), 0);
        if (options_.back)
            for (int i = plan_.frames - 2; i > 0; --i) out.push_back(i);
        return out;
    }

    const AnimateOptionTexts& options_;
    AnimatePlan plan_;
    PreparedModel& prepared_;
    MovingModel model_;
    MovingView view_;
    Job job_;
    std::vector<double> values_;
    double start_ = now_seconds();
};

}  // namespace

int run_animate(Arguments arguments) {
    AnimateOptionTexts options;
    CommandLine line(
        "animate", "animate MODEL -o FILE.gif --along NAME=A..B [options]",
        "Makes a moving picture of a model along one of its coordinates or parameters, or of a turn.",
        {"frep animate morph.hf -o morph.gif --along t=-10..10 --frames 60 --fps 25",
         "frep animate pot.hf -o pot.mp4 --turntable --material lacquer",
         "frep animate crest.hf -o crest.apng --along petals=3..9 --even --back"});
    declare_animate_options(line, options);
    if (const auto code = line.parse(arguments)) return *code;
    auto plan = plan_animate(options);
    if (!plan) return fail(plan.error());
    int code = exit_ok;
    auto prepared = prepare_model(options.look.model, code);
    if (!prepared) return code;
    if (const Status status = take_color_by(options.look, *prepared); !status) return fail(status.error());
    auto model = MovingModel::make(*prepared, plan->along);
    if (!model) return fail({model.error().kind, "--along: " + model.error().message});
    if (plan->along)
        if (const Status status = model->set(plan->along->from); !status) return fail(status.error());
    return AnimateRun(options, std::move(*plan), *prepared, std::move(*model)).run();
}

}  // namespace frep::cli
