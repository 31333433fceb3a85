// Implementation of plane_picture.h.
#include "frep/trace/plane_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "frep/base/parallel.h"
#include "frep/trace/plane_canvas.h"
#include "frep/trace/plane_colors.h"
#include "frep/trace/plane_layout.h"
#include "frep/trace/plane_levels.h"
#include "frep/trace/plane_samples.h"

namespace frep {

namespace {

using namespace drawing;

constexpr Color paper{1, 1, 1}, ink{0.1, 0.1, 0.1}, hatch_light{0.90, 0.90, 0.90},
    hatch_dark{0.62, 0.62, 0.62};
constexpr int samples_a_side = 2;
constexpr std::string_view undefined_label = "undefined";

/// Draws a figure, part by part.
class Figure {
  public:
    Figure(const FieldPictureOptions& options, Layout layout, const Levels& levels)
        : options_(options),
          layout_(std::move(layout)),
          levels_(levels),
          labels_(levels.uniform ? tick_labels({levels.step, levels.values}) : number_labels(levels.values)),
          colors_(band_colors(levels.values)) {
        for (const Color& color : colors_) linear_.push_back(linear_from_srgb(color));
        if (levels_.undefined > 0) add_swatch(layout_);
        if (options.width == 0) trim(layout_, right_of_bar());
        canvas_ = Canvas(layout_.width, layout_.height, paper);
    }

    void draw_values(const Lattice& lattice, const std::vector<double>& values);
    void draw_levels(const std::vector<std::vector<Segment>>& lines);
    void draw_axes();
    void draw_bar();
    Image image() && { return std::move(canvas_).image(); }

  private:
    double letter() const { return layout_.letter; }
    double line() const { return std::max(0.8, letter() / 11); }
    TextStyle style(double size = 1) const { return {letter() * size, true}; }
    /// Half the height of the numbers, which are centered on their ticks.
    double middle() const { return letter() / 2; }

    Color hatching(double x, double y) const;
    double x_of(double v) const;
    double y_of(double v) const;
    double right_of_bar() const;
    void draw_right_axis();
    void draw_up_axis();
    double level_y(std::size_t i) const;
    void draw_bar_bands();
    void draw_bar_numbers();
    bool below_first() const { return levels_.lowest < levels_.values.front(); }
    bool above_last() const { return levels_.highest > levels_.values.back(); }

    const FieldPictureOptions& options_;
    Layout layout_;
    const Levels& levels_;
    Labels labels_;  ///< of the levels
    std::vector<Color> colors_, linear_;
    Canvas canvas_{1, 1, paper};
};

/// The width of what is written beside the bar, at most what the layout reserves.
double Figure::right_of_bar() const {
    double width =
        text_width(options_.value_name + labels_.factor, letter()) - (layout_.bar_labels - layout_.bar.left);
    for (const std::string& text : labels_.texts) width = std::max(width, text_width(text, letter()));
    if (levels_.undefined > 0) width = std::max(width, text_width(undefined_label, letter()));
    return std::min(width, bar_label_letters * letter());
}

/// Grey paper with darker stripes from the lower left to the upper right.
Color Figure::hatching(double x, double y) const {
    const double period = 0.75 * letter(), along = (x + y) / period;
    const double phase = along - std::floor(along);
    return phase < 0.22 ? hatch_dark : hatch_light;
}

void Figure::draw_values(const Lattice& lattice, const std::vector<double>& values) {
    const std::size_t columns = lattice.columns();
    const int left = static_cast<int>(layout_.plot.left), top = static_cast<int>(layout_.plot.top);
    const std::size_t factor = static_cast<std::size_t>(lattice.factor);
    const double share = 1.0 / static_cast<double>(factor * factor);
    for (int row = 0; row < lattice.window.rows; ++row) {
        for (int column = 0; column < lattice.window.columns; ++column) {
            Color sum;
            for (std::size_t k = 0; k < factor * factor; ++k) {
                const std::size_t c = static_cast<std::size_t>(column) * factor + k % factor;
                const std::size_t r = static_cast<std::size_t>(row) * factor + k / factor;
                const double v = values[r * columns + c];
                const Color part =
                    v == v ? linear_[band_of(levels_.values, v)]
                           : linear_from_srgb(hatching(left + lattice.pixel(static_cast<double>(c)),
                                                       top + lattice.pixel(static_cast<double>(r))));
                sum = {sum.r + part.r * share, sum.g + part.g * share, sum.b + part.b * share};
            }
            canvas_.set(left + column, top + row, srgb_from_linear(sum));
        }
    }
}

void Figure::draw_levels(const std::vector<std::vector<Segment>>& lines) {
    const Vec2 origin{layout_.plot.left, layout_.plot.top};
    const auto moved = [&](std::vector<Segment> segments) {
        for (Segment& s : segments) s = {s.a + origin, s.b + origin};
        return segments;
    };
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (levels_.values[i] != 0) canvas_.stroke(moved(lines[i]), 0.8 * line(), ink, 0.45, layout_.plot);
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (levels_.values[i] == 0) canvas_.stroke(moved(lines[i]), 2.6 * line(), ink, 1, layout_.plot);
    }
}

double Figure::x_of(double v) const {
    return layout_.plot.left + (v - layout_.window.left) / layout_.window.step;
}

double Figure::y_of(double v) const {
    return layout_.plot.top + (layout_.window.top - v) / layout_.window.step;
}

void Figure::draw_right_axis() {
    const double y = layout_.plot.bottom, tick = 0.5 * letter();
    std::vector<Segment> ticks;
    for (std::size_t i = 0; i < layout_.right.ticks.values.size(); ++i) {
        const double x = x_of(layout_.right.ticks.values[i]);
        ticks.push_back({{x, y}, {x, y + tick}});
        canvas_.text(layout_.right.labels.texts[i], {x, y + tick + 1.6 * letter()}, TextAnchor::middle,
                     style(), ink);
    }
    canvas_.stroke(ticks, line(), ink);
    const double middle_x = (layout_.plot.left + layout_.plot.right) / 2;
    const std::string caption = fitted_text(layout_.right.caption, letter(), layout_.plot.width());
    canvas_.text(caption, {middle_x, y + tick + 3.9 * letter()}, TextAnchor::middle, style(), ink);
}

void Figure::draw_up_axis() {
    const double x = layout_.plot.left, tick = 0.5 * letter();
    std::vector<Segment> ticks;
    double widest = 0;
    for (std::size_t i = 0; i < layout_.up.ticks.values.size(); ++i) {
        const double y = y_of(layout_.up.ticks.values[i]);
        const std::string& text = layout_.up.labels.texts[i];
        ticks.push_back({{x, y}, {x - tick, y}});
        canvas_.text(text, {x - tick - 0.6 * letter(), y + middle()}, TextAnchor::end, style(), ink);
        widest = std::max(widest, text_width(text, letter()));
    }
    canvas_.stroke(ticks, line(), ink);
    const double middle_y = (layout_.plot.top + layout_.plot.bottom) / 2;
    const std::string caption = fitted_text(layout_.up.caption, letter(), layout_.plot.height());
    canvas_.text(caption, {x - tick - 1.7 * letter() - widest, middle_y}, TextAnchor::middle,
                 {letter(), false}, ink);
}

void Figure::draw_axes() {
    const double half = line() / 2;
    canvas_.frame({layout_.plot.left - half, layout_.plot.top - half, layout_.plot.right + half,
                   layout_.plot.bottom + half},
                  line(), ink);
    draw_right_axis();
    draw_up_axis();
    const double size = 1.2 * letter(), room = layout_.width - layout_.plot.left - letter();
    canvas_.text(fitted_text(options_.title, size, room),
                 {layout_.plot.left, layout_.plot.top - 1.3 * letter()}, TextAnchor::start, style(1.2), ink);
}

/// The height of level i: evenly spaced, from the foot of the bar to its head; a single one in the middle.
double Figure::level_y(std::size_t i) const {
    const std::size_t count = levels_.values.size();
    const double share =
        count == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(count - 1, 1));
    return layout_.bar.bottom - share * layout_.bar.height();
}

/// The bands between the levels, and pointed ends where values lie beyond them. A single level parts the bar.
void Figure::draw_bar_bands() {
    const PixelBox& bar = layout_.bar;
    const std::size_t count = levels_.values.size();
    const bool single = count == 1;
    const auto band = [&](double bottom, double top, std::size_t color) {
        canvas_.fill({bar.left, top, bar.right, bottom}, colors_[color]);
    };
    for (std::size_t i = 1; i < count; ++i) band(level_y(i - 1), level_y(i), i);
    if (single) {
        band(bar.bottom, level_y(0), 0);
        band(level_y(0), bar.top, 1);
    }
    std::vector<Segment> outline{{{bar.left, bar.top}, {bar.left, bar.bottom}},
                                 {{bar.right, bar.top}, {bar.right, bar.bottom}}};
    const auto end = [&](bool open, double y, double tip, const Color& color) {
        const Vec2 a{bar.left, y}, b{bar.right, y}, c{(bar.left + bar.right) / 2, tip};
        if (!open) {
            outline.push_back({a, b});
            return;
        }
        canvas_.fill_convex(std::array{a, b, c}, color);
        outline.push_back({a, c});
        outline.push_back({c, b});
    };
    end(above_last() && !single, bar.top, bar.top - layout_.point, colors_[count]);
    end(below_first() && !single, bar.bottom, bar.bottom + layout_.point, colors_[0]);
    std::vector<Segment> thin, bold;
    for (std::size_t i = 0; i < count; ++i) {
        const double y = level_y(i);
        (levels_.values[i] == 0 ? bold : thin).push_back({{bar.left, y}, {bar.right, y}});
    }
    canvas_.stroke(thin, 0.8 * line(), ink, 0.45, canvas_.whole());
    canvas_.stroke(bold, 2.6 * line(), ink);
    canvas_.stroke(outline, line(), ink);
}

/// A number for every level where there is room, else for every second, fifth ... counted from zero.
void Figure::draw_bar_numbers() {
    const PixelBox& bar = layout_.bar;
    const std::vector<double>& values = levels_.values;
    const double step = bar.height() / static_cast<double>(values.size());
    std::size_t anchor = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] == 0) anchor = i;
    }
    std::size_t stride = 1;
    for (const std::size_t next : {2U, 5U, 10U, 20U, 50U, 100U, 200U, 500U, 1000U}) {
        if (step * static_cast<double>(stride) >= 1.7 * letter()) break;
        stride = next;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if ((i + stride * values.size() - anchor) % stride != 0) continue;
        const double y = level_y(i);
        const std::string text = fitted_text(labels_.texts[i], letter(), bar_label_letters * letter());
        canvas_.text(text, {layout_.bar_labels, y + middle()}, TextAnchor::start, style(), ink);
    }
    const double above = above_last() && values.size() > 1 ? layout_.point : 0;
    const std::string caption = fitted_text(options_.value_name + labels_.factor, letter(),
                                            layout_.width - bar.left - 0.5 * letter());
    canvas_.text(caption, {bar.left, bar.top - above - 1.0 * letter()}, TextAnchor::start, style(), ink);
}

void Figure::draw_bar() {
    const PixelBox& swatch = layout_.swatch;
    if (levels_.undefined > 0) {
        for (int y = static_cast<int>(swatch.top); y < static_cast<int>(swatch.bottom); ++y) {
            for (int x = static_cast<int>(swatch.left); x < static_cast<int>(swatch.right); ++x)
                canvas_.set(x, y, hatching(x + 0.5, y + 0.5));
        }
        canvas_.frame(swatch, line(), ink);
        const double room = layout_.width - layout_.bar_labels - 0.4 * letter();
        canvas_.text(fitted_text(undefined_label, letter(), room),
                     {layout_.bar_labels, (swatch.top + swatch.bottom) / 2 + middle()}, TextAnchor::start,
                     style(), ink);
    }
    if (levels_.defined == 0) return;
    draw_bar_bands();
    draw_bar_numbers();
}

Status check_levels(const FieldPictureOptions& options) {
    constexpr int most = 1000;
    for (const double v : options.levels) {
        if (v - v != 0) return Error{ErrorKind::invalid_argument, "a level is not a finite number"};
    }
    const bool listed = !options.levels.empty();
    if (options.levels.size() > most || (!listed && (options.level_count < 1 || options.level_count > most)))
        return Error{ErrorKind::invalid_argument, fmt::format("the number of levels is not 1 to {}", most)};
    return {};
}

/// The lines of all levels; that of zero is exact.
std::vector<std::vector<Segment>> all_lines(FieldPool& fields, const Lattice& lattice,
                                            const std::vector<double>& values, const Levels& levels,
                                            const Job& job) {
    std::vector<std::vector<Segment>> lines(levels.values.size());
    parallel_for(job, lines.size(), [&](std::size_t i) {
        const FieldPool::Lease field = fields.borrow();
        lines[i] = isoline(lattice, values, levels.values[i], levels.values[i] == 0 ? &*field : nullptr);
    });
    return lines;
}

}  // namespace

bool can_draw_text(std::string_view utf8) { return drawing::has_glyphs(utf8); }

Result<FieldPicture> field_picture(const SampledField& field, const FieldPictureOptions& options,
                                   const Job& job) {
    if (const Status status = check_levels(options); !status) return status.error();
    auto layout = make_layout(options);
    if (!layout) return layout.error();
    FieldPool fields(field);
    const Lattice lattice{options.plane, layout->window, samples_a_side};
    const auto values = sample(fields, lattice, job);
    if (!values) return values.error();
    const Levels levels = options.levels.empty() ? choose_levels(*values, options.level_count)
                                                 : given_levels(*values, options.levels);
    const auto lines = all_lines(fields, lattice, *values, levels, job);
    if (job.cancelled()) return Error{ErrorKind::cancelled, "the picture was cancelled"};

    FieldPicture out;
    out.left = static_cast<int>(layout->plot.left);
    out.top = static_cast<int>(layout->plot.top);
    Figure figure(options, *layout, levels);
    figure.draw_values(lattice, *values);
    figure.draw_levels(lines);
    figure.draw_axes();
    figure.draw_bar();
    out.image = std::move(figure).image();
    out.levels = levels.values;
    out.samples = levels.defined + levels.undefined;
    out.undefined = levels.undefined;
    out.lowest = levels.lowest;
    out.highest = levels.highest;
    out.window = layout->window;
    return out;
}

}  // namespace frep
