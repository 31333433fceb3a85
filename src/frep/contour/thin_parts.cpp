// Implementation of thin_parts.h: candidates from comparisons of neighbours, a bit for each sample; then the
// few that are left in batches.
#include "frep/contour/thin_parts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "frep/contour/dual_block.h"

namespace frep::contouring {

namespace {

using Lattice = std::array<std::uint32_t, 3>;

constexpr std::uint32_t side = SampleBlock::side;
constexpr std::array<std::uint32_t, 3> stride{1, side, side* side};
/// Below 0 by how much of the steeper slope, a sample further, the lines of a top may meet: half the distance
/// of two lines of the lattice and a little more.
constexpr double near_miss = 0.6;
constexpr int line_steps = 4, gradient_steps = 7;
/// Between two points that tell a slope, in cells.
constexpr double tangent_step = 1.0 / 1024;
/// The place beside the last sample, or the first, in an edge whose line goes no further in this block.
constexpr double end_place = 1.0 / 8;
/// A step to where F vanishes by its gradient is longer by this part, so that it ends behind the surface.
constexpr double overshoot = 1.001;

/// |F| grows to (1 + 1 / (1 + near_miss)) times, at least, from a sample to the one behind it: more than 11
/// sixteenths of an octave, of which cutting off may take one and the mantissa, in place of its
/// logarithm, 1.4.
constexpr std::int16_t steep = 7;

using Eight = std::int16_t __attribute__((vector_size(16)));
constexpr Eight numbers{0, 1, 2, 3, 4, 5, 6, 7};
/// Of the first 16 bits of a binary64: all but the sign. As an integer it is 16 times the logarithm to
/// base 2.
constexpr std::int16_t magnitude = 0x7fff;
Eight load(const std::int16_t* p) {
    Eight out;
    std::memcpy(&out, p, sizeof out);
    return out;
}

std::uint32_t index(const Lattice& l) { return l[0] + l[1] * stride[1] + l[2] * stride[2]; }

double& component(Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Whether all samples of the block among these have one sign; those outside of it are no matter.
bool is_uniform(const SampleBlock& block, ThinParts::Around around) {
    auto& [begin, end] = around;
    for (std::size_t a = 0; a < 3; ++a) {
        begin[a] = std::max(begin[a], static_cast<std::int32_t>(block.first[a]));
        end[a] = std::min(end[a], static_cast<std::int32_t>(block.last[a]));
    }
    const std::uint32_t mask = (2u << end[0]) - (1u << begin[0]);
    std::uint32_t some = 0, all = mask;
    for (std::int32_t z = begin[2]; z <= end[2]; ++z) {
        for (std::int32_t y = begin[1]; y <= end[1]; ++y) {
            const std::uint32_t row = block.rows[static_cast<std::size_t>(z * static_cast<int>(side) + y)];
            some |= row & mask;
            all &= row;
        }
    }
    return some == 0 || all == mask;
}

/// The samples of the four cells around an edge, and of the 27 cells around a cell.
ThinParts::Around around_edge(const Lattice& lower, std::size_t axis) {
    ThinParts::Around out{};
    for (std::size_t a = 0; a < 3; ++a) {
        out.begin[a] = static_cast<std::int32_t>(lower[a]) - (a == axis ? 0 : 1);
        out.end[a] = static_cast<std::int32_t>(lower[a]) + 1;
    }
    return out;
}
ThinParts::Around around_cell(const Lattice& cell) {
    ThinParts::Around out{};
    for (std::size_t a = 0; a < 3; ++a) {
        out.begin[a] = static_cast<std::int32_t>(cell[a]) - 1;
        out.end[a] = static_cast<std::int32_t>(cell[a]) + 2;
    }
    return out;
}

/// The cell of the block at a point, the nearest where the point lies outside.
Lattice cell_at(const SampleBlock& block, const Vec3& point) {
    Lattice cell{};
    Vec3 way = point - block.point(block.first);
    for (std::size_t a = 0; a < 3; ++a) {
        const double c = block.first[a] + std::floor(component(way, a) / block.grid.cell);
        cell[a] = static_cast<std::uint32_t>(std::clamp(c, 0.0, block_side - 1.0));
    }
    return cell;
}

}  // namespace

std::span<const std::uint32_t> ThinParts::find(const SampleBlock& block, const BlockFields& fields) {
    cells_.clear();
    tops_.clear();
    collect(block);
    if (tops_.empty()) return {};
    close_ends(block, fields);
    follow_lines(block, fields);
    follow_gradients(block, fields);
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    return cells_;
}

/// Pairs of samples from which |F| grows so fast to both sides that lines come up to 0 within the pair, or
/// almost: eight pairs at once, by the first 16 bits of the values.
void ThinParts::collect(const SampleBlock& block) {
    for (std::size_t i = 0; i < block.values.size(); ++i)
        heads_[before_samples + i] =
            static_cast<std::int16_t>(std::bit_cast<std::uint64_t>(block.values[i]) >> 48);
    Lattice end{};
    for (std::size_t a = 0; a < 3; ++a) end[a] = std::min(block.last[a] + 1, block_side);
    const auto is_steep = [](Eight pair, Eight behind) {
        return ((behind & magnitude) - (pair & magnitude) > steep) & ((behind ^ pair) >= 0);
    };
    constexpr Eight none{}, all = ~none;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t low = block.first[axis], high = block.last[axis] - 1;  // of the pairs
        const std::uint32_t x_end = axis == 0 ? std::min(high + 1, end[0]) : end[0];
        const auto step = static_cast<std::ptrdiff_t>(stride[axis]);
        // No sample before the first pair or after the last.
        Eight no_before = numbers == static_cast<std::int16_t>(low);
        Eight no_after = numbers == static_cast<std::int16_t>(high);
        for (std::uint32_t z = block.first[2]; z < end[2]; ++z) {
            for (std::uint32_t y = block.first[1]; y < end[1]; ++y) {
                if (axis > 0) {
                    const std::uint32_t at = axis == 1 ? y : z;
                    if (at > high) break;
                    no_before = at == low ? all : none;
                    no_after = at == high ? all : none;
                }
                const std::int16_t* const here = &heads_[before_samples + (z * side + y) * side];
                const Eight lower = load(here), upper = load(here + step);
                const Eight found = ((lower ^ upper) >= 0) &
                                    (is_steep(lower, load(here - step)) | no_before) &
                                    (is_steep(upper, load(here + 2 * step)) | no_after);
                const auto words = std::bit_cast<std::array<std::uint64_t, 2>>(found);
                if ((words[0] | words[1]) == 0) continue;
                for (std::uint32_t x = block.first[0]; x < x_end; ++x)
                    if (found[x] != 0) add(block, {x, y, z}, axis);
            }
        }
    }
}

/// Adds a pair if the lines through the samples meet above 0, or almost.
void ThinParts::add(const SampleBlock& block, const Lattice& lower, std::size_t axis) {
    const Around around = around_edge(lower, axis);
    if (!is_uniform(block, around)) return;
    const double sign = block.values[index(lower)] >= 0 ? -1 : 1;
    const auto at = [&](int k) {
        Lattice l = lower;
        l[axis] += static_cast<std::uint32_t>(k);
        return Place{static_cast<double>(k), sign * block.values[index(l)]};
    };
    const bool has_before = lower[axis] > block.first[axis], has_after = lower[axis] + 1 < block.last[axis];
    if (!has_before && !has_after) return;
    const Place low = at(0), high = at(1);
    // From a side that is known the line must come up to 0 within the pair, or almost.
    const auto comes_up = [](const Place& end, const Place& behind) {
        const double rise = end.value - behind.value;
        return rise > 0 && end.value + (1 + near_miss) * rise >= 0;
    };
    if (has_before && !comes_up(low, at(-1))) return;
    if (has_after && !comes_up(high, at(2))) return;
    // A side without a sample gets a place within the pair, whose value close_ends() takes.
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    Top top;
    top.lower = block.point(lower);
    top.axis = static_cast<std::uint8_t>(axis);
    top.around = around;
    top.sign = sign;
    top.places = {has_before ? at(-1) : low, has_before ? low : Place{end_place, unknown},
                  has_after ? high : Place{1 - end_place, unknown}, has_after ? at(2) : high};
    tops_.push_back(top);
}

void ThinParts::Top::move_to(double at, double cell) {
    point = lower;
    component(point, axis) += at * cell;
}

/// Where the lines through the places meet, as `t`; nowhere: not between them, or far below 0.
ThinParts::Meeting ThinParts::Top::meeting() {
    const Place &low = places[1], &high = places[2];
    const double rise = (low.value - places[0].value) / (low.t - places[0].t);
    const double fall = (high.value - places[3].value) / (places[3].t - high.t);
    if (!(rise > 0) || !(fall > 0)) return Meeting::nowhere;
    t = (high.value - low.value + rise * low.t + fall * high.t) / (rise + fall);
    const double value_there = low.value + rise * (t - low.t);
    if (!(t > low.t && t < high.t)) return Meeting::nowhere;
    if (value_there >= 0) return Meeting::above;
    return value_there >= -near_miss * std::max(rise, fall) ? Meeting::below : Meeting::nowhere;
}

/// Puts the point at `t` and the one beside it on the side of the top where they lie.
void ThinParts::Top::narrow() {
    const Place here{t, first_value}, next{t + tangent_step, value};
    if (next.value > here.value) {
        places[0] = here;
        places[1] = next;
    } else {
        places[2] = here;
        places[3] = next;
    }
}

void ThinParts::take_points() {
    for (std::vector<double>* v : {&x_, &y_, &z_, &values_, &gx_, &gy_, &gz_}) v->resize(tops_.size());
    for (std::size_t i = 0; i < tops_.size(); ++i) {
        x_[i] = tops_[i].point.x;
        y_[i] = tops_[i].point.y;
        z_[i] = tops_[i].point.z;
    }
}

void ThinParts::take_values(SampledField& field) {
    if (tops_.empty()) return;
    take_points();
    field.values({x_, y_, z_}, values_);
    for (std::size_t i = 0; i < tops_.size(); ++i) tops_[i].value = tops_[i].sign * values_[i];
}

/// Whether the samples of the next blocks among these have the sign, too.
bool ThinParts::agree_beyond(const SampleBlock& block, const Around& around, bool inside,
                             SampledField& whole) {
    x_.clear();
    y_.clear();
    z_.clear();
    std::array<std::int32_t, 3> l{};
    for (l[2] = around.begin[2]; l[2] <= around.end[2]; ++l[2]) {
        for (l[1] = around.begin[1]; l[1] <= around.end[1]; ++l[1]) {
            for (l[0] = around.begin[0]; l[0] <= around.end[0]; ++l[0]) {
                bool is_known = true, is_in_box = true;
                Lattice at{};
                for (std::size_t a = 0; a < 3; ++a) {
                    is_known = is_known && l[a] >= 0 && l[a] < static_cast<std::int32_t>(side);
                    at[a] = block.lo[a] + static_cast<std::uint32_t>(l[a]) - 1;  // the layer wraps round
                    is_in_box = is_in_box && at[a] <= block.grid.cells[a];
                }
                if (is_known || !is_in_box) continue;
                const Vec3 p = block.grid.point(at[0], at[1], at[2]);
                x_.push_back(p.x);
                y_.push_back(p.y);
                z_.push_back(p.z);
            }
        }
    }
    values_.resize(x_.size());
    if (!x_.empty()) whole.values({x_, y_, z_}, values_);
    return std::all_of(values_.begin(), values_.end(), [=](double v) { return (v >= 0) == inside; });
}

/// Takes out the tops whose point has the other sign, and notes the cells where those are if all samples
/// around have one sign; takes out those that are undefined.
void ThinParts::drop_found(const SampleBlock& block, SampledField& whole, bool is_off_line) {
    std::erase_if(tops_, [&](const Top& top) {
        // F = 0 is inside: a wall without thickness is one, a gap without thickness is none.
        const bool is_found = top.sign > 0 ? top.value >= 0 : top.value > 0;
        if (!is_found) return !(top.value <= 0);
        const Lattice cell = cell_at(block, top.point);
        const Around around = is_off_line ? around_cell(cell) : top.around;
        if (is_uniform(block, around) && agree_beyond(block, around, top.sign < 0, whole))
            cells_.push_back(local_number(cell));
        return true;
    });
}

/// The values of the places within pairs, which have none yet; the others get theirs again.
void ThinParts::close_ends(const SampleBlock& block, const BlockFields& fields) {
    for (const std::size_t k : {1u, 2u}) {
        for (Top& top : tops_) top.move_to(top.places[k].t, block.grid.cell);
        take_values(fields.signs);
        drop_found(block, fields.whole, false);
        for (Top& top : tops_) top.places[k].value = top.value;
    }
}

/// Steps to where the two lines meet, and on with tangents. Leaves in `tops_` those that end below 0.
void ThinParts::follow_lines(const SampleBlock& block, const BlockFields& fields) {
    const double cell = block.grid.cell;
    near_.clear();
    for (int step = 0; step < line_steps; ++step) {
        std::erase_if(tops_, [&](Top& top) {
            const Meeting at = top.meeting();
            if (at == Meeting::below) near_.push_back(top);
            return at != Meeting::above;
        });
        for (Top& top : tops_) top.move_to(top.t, cell);
        take_values(fields.signs);
        drop_found(block, fields.whole, false);
        for (Top& top : tops_) {
            top.first_value = top.value;
            top.move_to(top.t + tangent_step, cell);
        }
        take_values(fields.signs);
        drop_found(block, fields.whole, false);
        for (Top& top : tops_) top.narrow();
    }
    tops_.swap(near_);
    for (Top& top : tops_) top.move_to(top.t, cell);
}

/// Follows -F / |grad F|^2 grad F up to the other sign, not farther than a cell and within the block.
void ThinParts::follow_gradients(const SampleBlock& block, const BlockFields& fields) {
    const Box3 box{block.point(block.first), block.point(block.last)};
    for (int step = 0; step < gradient_steps && !tops_.empty(); ++step) {
        take_points();
        fields.part.gradients({x_, y_, z_}, values_, {gx_, gy_, gz_});
        for (std::size_t i = 0; i < tops_.size(); ++i) {
            Top& top = tops_[i];
            top.value = top.sign * values_[i];
            top.gradient = top.sign * Vec3{gx_[i], gy_[i], gz_[i]};
        }
        drop_found(block, fields.whole, true);
        std::erase_if(tops_, [&](Top& top) {
            const double square = dot(top.gradient, top.gradient);
            top.point = top.point + (-overshoot * top.value / square) * top.gradient;
            const Vec3 way = top.point - top.lower;
            return !box.contains(top.point) || !(dot(way, way) <= 3 * block.grid.cell * block.grid.cell);
        });
    }
}

}  // namespace frep::contouring
