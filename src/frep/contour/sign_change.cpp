// Implementation of sign_change.h.
#include "frep/contour/sign_change.h"

#include <algorithm>

namespace frep::contouring {

namespace {

constexpr int narrowing_steps = 40;
constexpr double precision = 1e-3;  // of the distance
constexpr int looks = 8;            // along each direction of a refinement
constexpr int shortening_steps = 10;

bool is_finite(double v) { return v - v == 0; }

}  // namespace

void SignSearch::evaluate(std::size_t count) {
    values_.resize(count);
    field_.values({std::span(x_).first(count), std::span(y_).first(count), std::span(z_).first(count)},
                  std::span(values_).first(count));
}

/// Where each probe is, which way it looks, and the first step: where the tangent meets zero.
void SignSearch::take_gradients(std::span<const SignProbe> probes) {
    const std::size_t count = probes.size();
    for (std::vector<double>* v : {&x_, &y_, &z_, &gx_, &gy_, &gz_, &values_}) v->resize(2 * count);
    for (std::size_t i = 0; i < count; ++i) {
        x_[i] = probes[i].point.x;
        y_[i] = probes[i].point.y;
        z_[i] = probes[i].point.z;
    }
    const auto part = [count](std::vector<double>& v) { return std::span(v).first(count); };
    field_.gradients({part(x_), part(y_), part(z_)}, part(values_), {part(gx_), part(gy_), part(gz_)});
    lines_.assign(count, {});
    for (std::size_t i = 0; i < count; ++i) {
        Line& line = lines_[i];
        line.point = probes[i].point;
        line.direction = probes[i].direction;
        line.inside = values_[i] >= 0;
        line.step = start_;
        const Vec3 g{gx_[i], gy_[i], gz_[i]};
        const double size = length(g);
        if (!(size > 0) || !is_finite(size) || !is_finite(values_[i])) continue;
        line.direction = g / size;
        const double newton = (values_[i] < 0 ? -values_[i] : values_[i]) / size;
        // A way of no length is no way; one beyond the reach is left to the doubling.
        line.step = std::clamp(1.25 * newton, 1e-6 * start_, reach_);
        if (values_[i] == 0) {  // on the surface
            line.way = 1;
            line.high = 0;
        }
    }
}

/// Doubles the steps of the probes without a change, on both sides, up to the reach.
void SignSearch::expand() {
    active_.clear();
    for (std::size_t i = 0; i < lines_.size(); ++i)
        if (lines_[i].way == 0) active_.push_back(i);
    while (!active_.empty()) {
        for (std::size_t k = 0; k < active_.size(); ++k) {
            const Line& line = lines_[active_[k]];
            for (std::size_t side = 0; side < 2; ++side) {
                const Vec3 p = line.point + line.direction * (side == 0 ? line.step : -line.step);
                x_[2 * k + side] = p.x;
                y_[2 * k + side] = p.y;
                z_[2 * k + side] = p.z;
            }
        }
        evaluate(2 * active_.size());
        std::size_t kept = 0;
        for (std::size_t k = 0; k < active_.size(); ++k) {
            Line& line = lines_[active_[k]];
            const bool ahead = (values_[2 * k] >= 0) != line.inside;
            const bool behind = (values_[2 * k + 1] >= 0) != line.inside;
            if (ahead || behind) {
                // With a change on both sides, the one where the function falls (or rises) to zero.
                line.way = ahead && (!behind || !line.inside) ? 1 : -1;
                line.high = line.step;
                continue;
            }
            line.low = line.step;
            line.step *= 2;
            if (line.step <= reach_) active_[kept++] = active_[k];
        }
        active_.resize(kept);
    }
}

/// Halves the brackets that may hold the farthest change.
void SignSearch::narrow() {
    for (int step = 0; step < narrowing_steps; ++step) {
        double least = 0;  // the farthest distance is surely at least this
        for (const Line& line : lines_)
            if (line.way != 0) least = std::max(least, line.low);
        active_.clear();
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const Line& line = lines_[i];
            if (line.way == 0 || line.high <= least || line.high - line.low <= precision * line.high)
                continue;
            const Vec3 p = line.point + line.direction * (line.way * 0.5 * (line.low + line.high));
            x_[active_.size()] = p.x;
            y_[active_.size()] = p.y;
            z_[active_.size()] = p.z;
            active_.push_back(i);
        }
        if (active_.empty()) return;
        evaluate(active_.size());
        for (std::size_t k = 0; k < active_.size(); ++k) {
            Line& line = lines_[active_[k]];
            const bool changed = (values_[k] >= 0) != line.inside;
            (changed ? line.high : line.low) = 0.5 * (line.low + line.high);
        }
    }
}

std::vector<SignLine> SignSearch::search(std::span<const SignProbe> probes) {
    take_gradients(probes);
    expand();
    narrow();
    return std::move(lines_);
}

/// Replaces the line by the shortest of those in `directions` that find a change sooner.
void SignSearch::shorten(SignLine& line, std::span<const Vec3> directions) {
    const double longest = line.way == 0 ? reach_ : line.high;
    const std::size_t count = directions.size() * looks;
    for (std::vector<double>* v : {&x_, &y_, &z_}) v->resize(count);
    std::size_t at = 0;
    for (const Vec3& d : directions) {
        for (int k = 1; k <= looks; ++k, ++at) {
            const Vec3 p = line.point + d * (longest * k / looks);
            x_[at] = p.x;
            y_[at] = p.y;
            z_[at] = p.z;
        }
    }
    evaluate(count);
    int nearest = looks + 1;
    std::vector<int> firsts;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        int k = 1;
        while (k <= looks && (values_[i * looks + static_cast<std::size_t>(k) - 1] >= 0) == line.inside) ++k;
        firsts.push_back(k);
        nearest = std::min(nearest, k);
    }
    if (nearest > looks) return;
    lines_.clear();
    for (std::size_t i = 0; i < directions.size(); ++i) {
        if (firsts[i] != nearest) continue;
        Line found = line;
        found.direction = directions[i];
        found.way = 1;
        found.low = longest * (nearest - 1) / looks;
        found.high = longest * nearest / looks;
        lines_.push_back(found);
    }
    for (std::vector<double>* v : {&x_, &y_, &z_}) v->resize(lines_.size());
    for (int step = 0; step < shortening_steps; ++step) {
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const Vec3 p = line.point + lines_[i].direction * (0.5 * (lines_[i].low + lines_[i].high));
            x_[i] = p.x;
            y_[i] = p.y;
            z_[i] = p.z;
        }
        evaluate(lines_.size());
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const bool changed = (values_[i] >= 0) != line.inside;
            (changed ? lines_[i].high : lines_[i].low) = 0.5 * (lines_[i].low + lines_[i].high);
        }
    }
    for (const Line& found : lines_)
        if (line.way == 0 || found.high < line.high) line = found;
}

void SignSearch::refine(SignLine& line) {
    line.refined = true;
    std::vector<Vec3> directions;
    for (int i = 0; i < 27; ++i) {
        if (i == 13) continue;
        const Vec3 d{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
        directions.push_back(d / length(d));
    }
    shorten(line, directions);
    if (line.way == 0) return;
    // The nearest point of a smooth surface lies along its normal there.
    const Vec3 q = line.point + line.direction * (line.way * line.high);
    double value = 0;
    Vec3 g;
    field_.gradients({std::span(&q.x, 1), std::span(&q.y, 1), std::span(&q.z, 1)}, std::span(&value, 1),
                     {std::span(&g.x, 1), std::span(&g.y, 1), std::span(&g.z, 1)});
    const double size = length(g);
    if (!(size > 0) || !is_finite(size)) return;
    const Vec3 normals[] = {g / size, -(g / size)};
    shorten(line, normals);
}

}  // namespace frep::contouring
