// Implementation of distance_grid.h.
#include "frep/trace/distance_grid.h"

#include <algorithm>
#include <cmath>

#include "frep/base/parallel.h"
#include "frep/trace/distance_transform.h"

namespace frep::tracing {

namespace {

constexpr int block = 8;            ///< cells along the side of a block that is judged as one
constexpr int finest = 2;           ///< and of the smallest such block
constexpr int coarse_levels = 5;    ///< halvings of the box when the hull is looked for
constexpr int margin = 2;           ///< cells around the hull, at least
constexpr int probe_cells = 48;     ///< of the lattice that tells whether intervals help
constexpr int sampled_cells = 112;  ///< along the longest side, at most, where intervals say nothing
constexpr float deepest = -2.0F;    ///< distances inside are cut off here
constexpr float widest_band = 1.75F;

struct Hull {
    Box3 box;
    bool is_empty = true;
    double undecided = 0;  ///< share of the hull's coarse cells
};

Box3 octant(const Box3& box, unsigned c) {
    const Vec3 m = (box.min + box.max) * 0.5;
    return {{c & 1 ? m.x : box.min.x, c & 2 ? m.y : box.min.y, c & 4 ? m.z : box.min.z},
            {c & 1 ? box.max.x : m.x, c & 2 ? box.max.y : m.y, c & 4 ? box.max.z : m.z}};
}

double volume(const Box3& box) {
    const Vec3 side = box.max - box.min;
    return side.x * side.y * side.z;
}

/// The hull of the coarse cells of `clip` that may hold some of the solid.
Hull find_hull(SampledField& field, const Box3& clip) {
    std::vector<FieldPart> parts{{clip, nullptr}}, children;
    std::vector<SignRange> ranges;
    for (int level = 0; level <= coarse_levels; ++level) {
        ranges.resize(parts.size());
        narrow_parts(field, parts, ranges);
        Hull hull;
        double undecided = 0;
        children.clear();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (!ranges[i].can_be_inside) continue;
            const Box3& box = parts[i].box;
            hull.box = hull.is_empty ? box : joined(hull.box, box);
            hull.is_empty = false;
            if (ranges[i].can_be_outside || ranges[i].can_be_undefined) undecided += volume(box);
            for (unsigned c = 0; c < 8 && level < coarse_levels; ++c)
                children.push_back({octant(box, c), parts[i].field});
        }
        if (hull.is_empty) return hull;
        if (level == coarse_levels) {
            hull.undecided = undecided / volume(hull.box);
            return hull;
        }
        parts.swap(children);
    }
    return {};
}

/// What is known of a box, clipped: `whole` if no part of it lies beyond the clip box.
CellState judge(const SignRange& range, bool whole) {
    if (!range.can_be_inside) return CellState::outside;
    return whole && !range.can_be_outside && !range.can_be_undefined ? CellState::inside : CellState::mixed;
}

double outside_of(const Box3& box, Vec3 p) {
    return std::max({box.min.x - p.x, p.x - box.max.x, box.min.y - p.y, p.y - box.max.y, box.min.z - p.z,
                     p.z - box.max.z});
}

}  // namespace

CellState& DistanceGrid::state_at(int i, int j, int k) {
    return states_[(static_cast<std::size_t>(k) * size(1) + static_cast<std::size_t>(j)) * size(0) +
                   static_cast<std::size_t>(i)];
}

Box3 DistanceGrid::cell_box(std::array<int, 3> lo, int side) const {
    // A hair wider, so that rounding leaves no gap between neighbours.
    const double hair = 1e-9 * step_;
    const Vec3 out{hair, hair, hair};
    return {corner(lo[0], lo[1], lo[2]) - out, corner(lo[0] + side, lo[1] + side, lo[2] + side) + out};
}

Result<DistanceGrid> DistanceGrid::make(FieldPool& fields, const Box3& clip, int cells, const Job& job) {
    DistanceGrid grid;
    grid.clip_ = clip;
    const Hull hull = find_hull(*fields.borrow(), clip);
    if (hull.is_empty) return grid;
    if (hull.undecided > 0.5) {
        // Either intervals say nothing or the solid is thin: finer cells leave a thin one mostly empty.
        grid.place(hull.box, probe_cells);
        grid.classify(fields, job);
        const auto mixed = std::count(grid.states_.begin(), grid.states_.end(), CellState::mixed);
        grid.sampled_ = static_cast<double>(mixed) > 0.6 * static_cast<double>(grid.states_.size());
    }
    grid.place(hull.box, grid.sampled_ ? std::min(cells, sampled_cells) : cells);
    if (grid.sampled_)
        grid.classify_by_samples(fields, job);
    else
        grid.classify(fields, job);
    if (!job.cancelled()) grid.measure(fields, job);
    if (job.cancelled()) return Error{ErrorKind::cancelled, "the picture was cancelled"};
    return grid;
}

void DistanceGrid::place(const Box3& hull, int cells) {
    const Vec3 side = hull.max - hull.min;
    const double longest = std::max({side.x, side.y, side.z});
    step_ = longest / std::max(cells - 2 * margin, 4);
    const double sides[3] = {side.x, side.y, side.z};
    for (std::size_t a = 0; a < 3; ++a) {
        const int count = static_cast<int>(__builtin_ceil(sides[a] / step_ - 1e-6)) + 2 * margin;
        cells_[a] = (count + block - 1) / block * block;
    }
    per_unit_ = 1 / step_;
    // The last place before the last corner, so that there is always a next one.
    for (std::size_t a = 0; a < 3; ++a) far_[a] = static_cast<float>(cells_[a]) * (1 - 0x1p-22F);
    const Vec3 middle = (hull.min + hull.max) * 0.5;
    origin_ = middle - Vec3{cells_[0] * 0.5, cells_[1] * 0.5, cells_[2] * 0.5} * step_;
    states_.assign(size(0) * size(1) * size(2), CellState::outside);
}

/// The part of the box of some cells that lies in the clip box; its min is above its max when there is none.
Box3 DistanceGrid::clipped_box(std::array<int, 3> lo, int side) const {
    const Box3 box = cell_box(lo, side);
    return {{std::max(box.min.x, clip_.min.x), std::max(box.min.y, clip_.min.y),
             std::max(box.min.z, clip_.min.z)},
            {std::min(box.max.x, clip_.max.x), std::min(box.max.y, clip_.max.y),
             std::min(box.max.z, clip_.max.z)}};
}

/// Blocks of cells, then their halves, a row of blocks a task.
void DistanceGrid::classify(FieldPool& fields, const Job& job) {
    const int bx = cells_[0] / block, by = cells_[1] / block, bz = cells_[2] / block;
    parallel_for(job, static_cast<std::size_t>(by * bz), [&](std::size_t task) {
        const FieldPool::Lease field = fields.borrow();
        const int j0 = static_cast<int>(task) % by * block, k0 = static_cast<int>(task) / by * block;
        std::vector<std::array<int, 3>> corners, next_corners;
        std::vector<FieldPart> parts, next;
        std::vector<SignRange> ranges;
        const auto add = [&](std::array<int, 3> lo, int side, const std::shared_ptr<SampledField>& of) {
            const Box3 box = clipped_box(lo, side);
            if (box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z) return;
            next_corners.push_back(lo);
            next.push_back({box, of});
        };
        for (int i = 0; i < bx; ++i) add({i * block, j0, k0}, block, nullptr);
        for (int side = block; side >= finest; side /= 2) {
            corners.swap(next_corners), parts.swap(next);
            next_corners.clear(), next.clear();
            ranges.resize(parts.size());
            narrow_parts(*field, parts, ranges);
            for (std::size_t b = 0; b < parts.size(); ++b) {
                const std::array<int, 3> lo = corners[b];
                const CellState state = judge(ranges[b], parts[b].box == cell_box(lo, side));
                if (state == CellState::mixed && side > finest) {
                    const int half = side / 2;
                    for (int c = 0; c < 8; ++c)
                        add({lo[0] + (c & 1) * half, lo[1] + (c >> 1 & 1) * half, lo[2] + (c >> 2) * half},
                            half, parts[b].field);
                } else if (state != CellState::outside) {
                    set_states(lo, side, state);
                }
            }
        }
    });
}

void DistanceGrid::set_states(std::array<int, 3> lo, int side, CellState state) {
    for (int k = 0; k < side; ++k)
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) state_at(lo[0] + i, lo[1] + j, lo[2] + k) = state;
}

/// Cells near a change of sign between corners are mixed, those between inside corners inside.
void DistanceGrid::classify_by_samples(FieldPool& fields, const Job& job) {
    const std::size_t nx = corners(0), ny = corners(1), nz = corners(2);
    std::vector<std::uint8_t> is_inside(nx * ny * nz, 0);
    parallel_for(job, nz, [&](std::size_t k) {
        const FieldPool::Lease field = fields.borrow();
        std::vector<double> x(nx), y(nx), z(nx), f(nx);
        for (std::size_t j = 0; j < ny; ++j) {
            for (std::size_t i = 0; i < nx; ++i) {
                const Vec3 p = corner(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
                x[i] = p.x, y[i] = p.y, z[i] = p.z;
            }
            field->values({x, y, z}, f);
            for (std::size_t i = 0; i < nx; ++i)
                is_inside[(k * ny + j) * nx + i] = f[i] >= 0 && clip_.contains({x[i], y[i], z[i]}) ? 1 : 0;
        }
    });
    const int reach = 1;
    for (int k = 0; k < cells_[2]; ++k)
        for (int j = 0; j < cells_[1]; ++j)
            for (int i = 0; i < cells_[0]; ++i) {
                int inside = 0, seen = 0;
                for (int c = std::max(k - reach, 0); c <= std::min(k + 1 + reach, cells_[2]); ++c)
                    for (int b = std::max(j - reach, 0); b <= std::min(j + 1 + reach, cells_[1]); ++b)
                        for (int a = std::max(i - reach, 0); a <= std::min(i + 1 + reach, cells_[0]); ++a) {
                            ++seen;
                            inside +=
                                is_inside[(static_cast<std::size_t>(c) * ny + static_cast<std::size_t>(b)) *
                                              nx +
                                          static_cast<std::size_t>(a)];
                        }
                state_at(i, j, k) = inside == 0      ? CellState::outside
                                    : inside == seen ? CellState::inside
                                                     : CellState::mixed;
            }
}

void DistanceGrid::measure(FieldPool& fields, const Job& job) {
    distance_.assign(corners(0) * corners(1) * corners(2), 0);
    std::vector<std::uint8_t> band(distance_.size(), 0);
    std::vector<float> values(distance_.size(), 0);
    parallel_for(job, corners(2),
                 [&](std::size_t k) { sample_layer(*fields.borrow(), static_cast<int>(k), band, values); });
    parallel_for(job, corners(2), [&](std::size_t k) { measure_slopes(static_cast<int>(k), band, values); });
    if (job.cancelled()) return;
    refine_at_crossings(band);
    collect_surface(band);
    spread(band, job);
}

/// F at the corners of mixed cells in layer k; the other corners get a sign.
void DistanceGrid::sample_layer(SampledField& field, int k, std::vector<std::uint8_t>& band,
                                std::vector<float>& values) {
    std::vector<std::size_t> places;
    std::vector<double> x, y, z;
    const std::size_t first = static_cast<std::size_t>(k) * corners(0) * corners(1);
    for (int j = 0; j <= cells_[1]; ++j) {
        for (int i = 0; i <= cells_[0]; ++i) {
            bool is_mixed = false, is_outside = false;
            for (int c = 0; c < 8; ++c) {
                const int a = i - (c & 1), b = j - (c >> 1 & 1), d = k - (c >> 2);
                if (a < 0 || b < 0 || d < 0 || a >= cells_[0] || b >= cells_[1] || d >= cells_[2]) {
                    is_outside = true;
                    continue;
                }
                is_mixed = is_mixed || state(a, b, d) == CellState::mixed;
                is_outside = is_outside || state(a, b, d) == CellState::outside;
            }
            const std::size_t place =
                first + static_cast<std::size_t>(j) * corners(0) + static_cast<std::size_t>(i);
            distance_[place] = is_outside ? 1.0F : deepest;
            if (!is_mixed) continue;
            const Vec3 p = corner(i, j, k);
            places.push_back(place);
            x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
        }
    }
    if (places.empty()) return;
    std::vector<double> f(places.size());
    field.values({x, y, z}, f);
    for (std::size_t p = 0; p < places.size(); ++p) {
        band[places[p]] = 1;
        const auto value = static_cast<float>(f[p]);
        values[places[p]] = f[p] < 0 && value == 0 ? -1e-37F : value;  // the sign stays
    }
}

/// Distances of first order, F/|grad F| with differences between neighbours for derivatives.
void DistanceGrid::measure_slopes(int k, const std::vector<std::uint8_t>& band,
                                  const std::vector<float>& values) {
    const std::array<std::size_t, 3> strides{1, corners(0), corners(0) * corners(1)};
    for (int j = 0; j <= cells_[1]; ++j) {
        for (int i = 0; i <= cells_[0]; ++i) {
            const std::array<int, 3> at{i, j, k};
            const std::size_t p = static_cast<std::size_t>(k) * strides[2] +
                                  static_cast<std::size_t>(j) * strides[1] + static_cast<std::size_t>(i);
            if (!band[p]) continue;
            const double f = double{values[p]};
            double square = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                const bool has_less = at[a] > 0 && band[p - strides[a]];
                const bool has_more = at[a] < cells_[a] && band[p + strides[a]];
                const double less = has_less ? double{values[p - strides[a]]} : f;
                const double more = has_more ? double{values[p + strides[a]]} : f;
                const double slope = (more - less) / (has_less && has_more ? 2 : 1);
                // Across a crease the steeper side counts.
                const double steepest = std::max(__builtin_fabs(more - f), __builtin_fabs(f - less));
                const double used = std::max(__builtin_fabs(slope), 0.7 * steepest);
                if (used - used == 0) square += used * used;
            }
            double d = -f / __builtin_sqrt(square);
            if (!(f >= 0)) d = d > 0 ? d : 1;
            if (f >= 0 && !(d <= 0)) d = -1;
            d = std::max(d, outside_of(clip_, corner(i, j, k)) / step_);
            distance_[p] = static_cast<float>(std::clamp(d, double{-widest_band}, double{widest_band}));
        }
    }
}

/// Where the sign changes along an edge, the surface is not farther than the edge is long.
void DistanceGrid::refine_at_crossings(std::vector<std::uint8_t>& band) {
    const std::size_t nx = corners(0), ny = corners(1), nz = corners(2);
    const std::array<std::size_t, 3> strides{1, nx, nx * ny};
    std::vector<float> limit(distance_.size(), widest_band);
    for (std::size_t k = 0; k < nz; ++k)
        for (std::size_t j = 0; j < ny; ++j)
            for (std::size_t i = 0; i < nx; ++i) {
                const std::size_t p = (k * ny + j) * nx + i;
                if (!band[p]) continue;
                const std::array<bool, 3> has_next{i + 1 < nx, j + 1 < ny, k + 1 < nz};
                for (std::size_t a = 0; a < 3; ++a) {
                    const std::size_t q = p + strides[a];
                    if (!has_next[a] || !band[q] || (distance_[p] > 0) == (distance_[q] > 0)) continue;
                    const float dp = std::fabs(distance_[p]), dq = std::fabs(distance_[q]);
                    const float share = dp + dq > 0 ? dp / (dp + dq) : 0.5F;
                    limit[p] = std::min(limit[p], share);
                    limit[q] = std::min(limit[q], 1 - share);
                }
            }
    for (std::size_t p = 0; p < distance_.size(); ++p)
        if (band[p]) distance_[p] = std::clamp(distance_[p], -limit[p], limit[p]);
}

void DistanceGrid::collect_surface(const std::vector<std::uint8_t>& band) {
    std::size_t p = 0;
    for (int k = 0; k <= cells_[2]; ++k)
        for (int j = 0; j <= cells_[1]; ++j)
            for (int i = 0; i <= cells_[0]; ++i, ++p)
                if (band[p] && distance_[p] <= 0.5F) {
                    const Vec3 at = corner(i, j, k);
                    const double height = at.z + double{distance_[p]} * step_;
                    lowest_ = surface_points_.empty() ? height : std::min(lowest_, height);
                    surface_points_.push_back(at);
                }
    if (!surface_points_.empty()) return;
    lowest_ = clip_.min.z;
    for (int k = 0; k < cells_[2]; ++k)
        for (int j = 0; j < cells_[1]; ++j)
            for (int i = 0; i < cells_[0]; ++i)
                if (state(i, j, k) != CellState::outside)
                    surface_points_.push_back(corner(i, j, k) + Vec3{0.5, 0.5, 0.5} * step_);
}

/// Distances beyond the band.
void DistanceGrid::spread(const std::vector<std::uint8_t>& band, const Job& job) {
    std::vector<float> squares(distance_.size(), no_seed);
    for (std::size_t p = 0; p < squares.size(); ++p)
        if (band[p] && distance_[p] <= 1) squares[p] = distance_[p] * distance_[p];
    distance_transform(squares, {corners(0), corners(1), corners(2)}, job);
    for (std::size_t p = 0; p < squares.size(); ++p)
        if (distance_[p] > 0 && (!band[p] || distance_[p] > 1))
            distance_[p] = std::max(std::sqrt(squares[p]), 1.0F);
}

double DistanceGrid::distance(Vec3 p) const {
    const auto u = static_cast<float>((p.x - origin_.x) * per_unit_),
               v = static_cast<float>((p.y - origin_.y) * per_unit_),
               w = static_cast<float>((p.z - origin_.z) * per_unit_);
    const float cu = std::clamp(u, 0.0F, far_[0]), cv = std::clamp(v, 0.0F, far_[1]),
                cw = std::clamp(w, 0.0F, far_[2]);
    const int i = static_cast<int>(cu), j = static_cast<int>(cv), k = static_cast<int>(cw);
    const float a = cu - static_cast<float>(i), b = cv - static_cast<float>(j),
                c = cw - static_cast<float>(k);
    const std::size_t sy = corners(0), sz = corners(0) * corners(1);
    const float* d = distance_.data() + static_cast<std::size_t>(k) * sz + static_cast<std::size_t>(j) * sy +
                     static_cast<std::size_t>(i);
    const float d00 = d[0] + a * (d[1] - d[0]), d10 = d[sy] + a * (d[sy + 1] - d[sy]);
    const float d01 = d[sz] + a * (d[sz + 1] - d[sz]), d11 = d[sz + sy] + a * (d[sz + sy + 1] - d[sz + sy]);
    const float d0 = d00 + b * (d10 - d00), d1 = d01 + b * (d11 - d01);
    const float inner = d0 + c * (d1 - d0);
    const float du = u - cu, dv = v - cv, dw = w - cw;
    const float beyond = du * du + dv * dv + dw * dw;
    // The nearest point of the convex lattice is nearer to everything in it than p is.
    if (beyond > 1e-6F) return double{__builtin_sqrtf(beyond + inner * inner)} * step_;
    return double{inner} * step_;
}

Vec3 DistanceGrid::direction(Vec3 p) const {
    const double h = 0.75 * step_;
    const Vec3 g{distance({p.x + h, p.y, p.z}) - distance({p.x - h, p.y, p.z}),
                 distance({p.x, p.y + h, p.z}) - distance({p.x, p.y - h, p.z}),
                 distance({p.x, p.y, p.z + h}) - distance({p.x, p.y, p.z - h})};
    const double size = length(g);
    return size > 0 ? g / size : Vec3{};
}

}  // namespace frep::tracing
