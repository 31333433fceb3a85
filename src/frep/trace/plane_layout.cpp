// Implementation of plane_layout.h.
#include "frep/trace/plane_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frep::drawing {

namespace {

constexpr double usual_side = 640;  // of a plot whose picture has no stated size

/// Free space around the plot, in pixels.
struct Margins {
    double left, top, right, bottom;
};

double widest(const Labels& labels, double letter) {
    double width = 0;
    for (const std::string& text : labels.texts) width = std::max(width, text_width(text, letter));
    return width;
}

Margins margins_of(const FieldPictureOptions& options, double up_labels, double letter) {
    Margins m{};
    m.left = std::ceil(up_labels + letter * (options.up_name.empty() ? 2.4 : 4.4));
    m.bottom = std::ceil(letter * (options.right_name.empty() ? 3.4 : 5.6));
    m.top = std::ceil(letter * (options.title.empty() ? 1.6 : 4.0));
    m.right = std::ceil(letter * (1.8 + 1.6 + 0.8 + bar_label_letters + 0.8));
    return m;
}

/// As many ticks as there is room for: `room(labels)` tells how many of them fit.
template <class Room>
Axis make_axis(double low, double high, const std::string& caption, Room&& room) {
    Axis axis;
    for (int count = 10; count >= 1; --count) {
        axis.ticks = round_ticks(low, high, count);
        axis.labels = tick_labels(axis.ticks);
        if (static_cast<double>(axis.ticks.values.size()) <= room(axis.labels)) break;
    }
    axis.caption = caption + axis.labels.factor;
    return axis;
}

/// Columns and rows of the plot in the room that is left, in the shape of the part; neither below `least`.
struct PlotSize {
    int columns, rows;
};
PlotSize plot_size(const Rectangle& part, double width, double height, double least) {
    const double step = std::max(part.width() / width, part.height() / height);
    const auto pixels = [&](double length, double most) {
        return static_cast<int>(std::clamp(std::round(length / step), std::min(least, most), most));
    };
    return {pixels(part.width(), width), pixels(part.height(), height)};
}

Error invalid(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }

Status check_sizes(const FieldPictureOptions& o) {
    const bool automatic = o.width == 0 && o.height == 0;
    const auto within = [](int v, int least) { return v >= least && v <= greatest_picture_side; };
    if (!automatic && !(within(o.width, least_figure_width) && within(o.height, least_figure_height)))
        return invalid(fmt::format("a figure of {} x {} pixels is out of range: {} x {} to {} x {}", o.width,
                                   o.height, least_figure_width, least_figure_height, greatest_picture_side,
                                   greatest_picture_side));
    const double width = o.part.width(), height = o.part.height();
    if (!(width > 0 && height > 0) || width - width != 0 || height - height != 0)
        return invalid("the part of the plane to show is empty or not finite");
    return {};
}

}  // namespace

namespace {

/// The room for the plot when the labels of the upright axis are `up_labels` wide, and what follows from it:
/// the size of the picture, plot, window and axes.
Status place_plot(const FieldPictureOptions& options, double up_labels, Layout& out) {
    const bool automatic = options.width == 0;
    const double letter = out.letter;
    const Margins m = margins_of(options, up_labels, letter);
    const double width = automatic ? usual_side : options.width - m.left - m.right;
    const double height = automatic ? usual_side : options.height - m.top - m.bottom;
    if (width < 4 * letter || height < 4 * letter)
        return invalid(
            fmt::format("a figure of {} x {} pixels has no room for a plot", options.width, options.height));
    const PlotSize plot = plot_size(options.part, width, height, 14 * letter);
    const Result<Window> window = Window::around(options.part, plot.columns, plot.rows);
    if (!window) return window.error();
    out.window = *window;
    out.width = automatic ? plot.columns + static_cast<int>(m.left + m.right) : options.width;
    out.height = automatic ? plot.rows + static_cast<int>(m.top + m.bottom) : options.height;
    out.plot.left = m.left + std::floor((out.width - m.left - m.right - plot.columns) / 2);
    out.plot.top = m.top + std::floor((out.height - m.top - m.bottom - plot.rows) / 2);
    out.plot.right = out.plot.left + plot.columns;
    out.plot.bottom = out.plot.top + plot.rows;
    const Rectangle seen = window->rectangle();
    out.up = make_axis(seen.min.y, seen.max.y, options.up_name,
                       [&](const Labels&) { return std::max(1.0, plot.rows / (2.6 * letter)); });
    out.right = make_axis(seen.min.x, seen.max.x, options.right_name, [&](const Labels& labels) {
        return std::max(1.0, plot.columns / (widest(labels, letter) + 1.8 * letter));
    });
    return {};
}

}  // namespace

Result<Layout> make_layout(const FieldPictureOptions& options) {
    if (const Status status = check_sizes(options); !status) return status.error();
    Layout out;
    if (options.width > 0) {
        const double size = std::sqrt(static_cast<double>(options.width) * options.height);
        out.letter = std::clamp(size / 75, 6.5, 200.0);
    }
    const double letter = out.letter;
    // The labels of the upright axis take their width from the plot, and the plot decides about the labels.
    double up_labels = 2 * letter;
    for (int pass = 0; pass < 4; ++pass) {
        if (const Status status = place_plot(options, up_labels, out); !status) return status.error();
        const double needed = widest(out.up.labels, letter);
        if (pass > 0 && needed <= up_labels) break;
        up_labels = pass == 0 ? needed : std::max(up_labels, needed);
    }
    out.point = std::round(1.3 * letter);
    out.bar.left = out.plot.right + std::round(1.8 * letter);
    out.bar.right = out.bar.left + std::round(1.5 * letter);
    out.bar.top = out.plot.top + out.point + std::round(1.9 * letter);
    out.bar.bottom = out.plot.bottom - out.point;
    out.bar_labels = out.bar.right + std::round(0.8 * letter);
    return out;
}

void add_swatch(Layout& layout) {
    const double side = std::round(1.5 * layout.letter);
    layout.swatch = {layout.bar.left, layout.plot.bottom - side, layout.bar.right, layout.plot.bottom};
    layout.bar.bottom = layout.swatch.top - std::round(0.9 * layout.letter) - layout.point;
}

void trim(Layout& layout, double label_width) {
    const double right = std::ceil(layout.bar_labels + label_width + 1.2 * layout.letter);
    layout.width = std::min(layout.width, static_cast<int>(right));
}

}  // namespace frep::drawing
