// Implementation of blend_search.h.
#include "frep/measure/blend_search.h"

#include <algorithm>
#include <cmath>

#include "frep/measure/connected.h"

namespace frep::measuring {

namespace {

/// The box has 2^levels cells along its longest side, unless they or the samples in them cost too much.
constexpr int levels = 7;
constexpr std::size_t most_cells = 40'000;
/// Where no sample is changed, cells are divided to this level for one that is, or for a proof.
constexpr int deepest = 11;
/// Samples along a side of a cell.
constexpr std::uint32_t samples_a_cell = BlendSearch::usual_samples >> levels;
/// Operations on samples at most, about.
constexpr double most_work = 2e9;
/// From this level on samples in the middles of cells are looked at.
constexpr int first_sampled = 2;
/// Parts with less than this share of the samples of the largest are ragged ends of it.
constexpr double smallest_part = 0.02;
constexpr std::size_t fewest_samples = 8;
/// Samples of a part that are compared for the largest change.
constexpr std::size_t most_compared = 4096;

bool has(std::uint16_t mask, int lane) { return (mask >> lane & 1u) != 0; }

}  // namespace

BlendSearch::BlendSearch(ClauseTape change, ClauseTape joint, MeasuredBox box)
    : change_(std::make_shared<const ClauseTape>(std::move(change))),
      joint_(std::move(joint)),
      box_(std::move(box)) {
    for (const std::size_t axis : box_.axes) {
        const double side = box_.cell.high[axis] - box_.cell.low[axis];
        cells_[axis] = std::max(1u, static_cast<std::uint32_t>(std::ceil(side / cell_size(levels))));
    }
}

double BlendSearch::cell_size(int level) const { return box_.longest / (1u << level); }

std::uint32_t BlendSearch::samples_a_side(int level) const { return samples_a_cell << level; }

void BlendSearch::set_lane(BoxLanes& boxes, std::size_t lane, const std::array<double, 3>& low,
                           double size) const {
    for (std::size_t axis = 0; axis < 3; ++axis) boxes.lo[axis][lane] = boxes.hi[axis][lane] = 0;
    for (const std::size_t axis : box_.axes) {
        boxes.lo[axis][lane] = low[axis];
        boxes.hi[axis][lane] = low[axis] + size;
    }
}

/// The cells in which the blend may change something, with the tapes cut for them.
std::vector<BlendSearch::OpenCell> BlendSearch::judged(const std::vector<OpenCell>& cells, int level) {
    std::vector<OpenCell> out;
    BoxLanes boxes;
    for (std::size_t first = 0, last = 0; first < cells.size(); first = last) {
        const ClauseTape& tape = *cells[first].tape;
        while (last < cells.size() && last - first < tile_lanes && cells[last].tape == cells[first].tape)
            ++last;
        boxes.count = static_cast<int>(last - first);
        for (std::size_t i = first; i < last; ++i) {
            std::array<double, 3> low{};
            for (const std::size_t axis : box_.axes)
                low[axis] = box_.cell.low[axis] + cell_size(level) * cells[i].at[axis];
            set_lane(boxes, i - first, low, cell_size(level));
        }
        pruner_.cut(tape, boxes, Purpose::occupancy, cut_);
        std::array<std::shared_ptr<const ClauseTape>, tile_lanes> made;
        std::array<bool, tile_lanes> is_idle{};
        for (int t = 0; t < cut_.tape_count; ++t) {
            const auto k = static_cast<std::size_t>(t);
            is_idle[k] = surely_no_change(cut_.tapes[k]);
            if (!is_idle[k]) made[k] = std::make_shared<const ClauseTape>(cut_.tapes[k]);
        }
        for (std::size_t i = first; i < last; ++i) {
            const int lane = static_cast<int>(i - first);
            if (!has(cut_.ranges.can_be_inside, lane)) continue;
            const int number = cut_.tape_of[static_cast<std::size_t>(lane)];
            if (number < 0) {
                out.push_back(cells[i]);
            } else if (!is_idle[static_cast<std::size_t>(number)]) {
                out.push_back({cells[i].at, made[static_cast<std::size_t>(number)]});
            }
        }
    }
    return out;
}

std::vector<BlendSearch::OpenCell> BlendSearch::children(const std::vector<OpenCell>& cells,
                                                         int level) const {
    std::vector<OpenCell> out;
    for (const OpenCell& cell : cells) {
        for (std::uint32_t c = 0; c < 1u << box_.axes.size(); ++c) {
            OpenCell child{{}, cell.tape};
            bool is_in = true;
            for (std::size_t k = 0; k < box_.axes.size(); ++k) {
                const std::size_t axis = box_.axes[k];
                child.at[axis] = 2 * cell.at[axis] + (c >> k & 1u);
                const std::uint32_t usual =
                    level <= levels ? child.at[axis] << (levels - level) : child.at[axis] >> (level - levels);
                is_in = is_in && usual < cells_[axis];
            }
            if (is_in) out.push_back(std::move(child));
        }
    }
    return out;
}

bool BlendSearch::is_changed_at_middle(const std::vector<OpenCell>& cells, int level) {
    std::array<std::vector<double>, 3> columns;
    std::vector<double> values;
    for (std::size_t first = 0, last = 0; first < cells.size(); first = last) {
        while (last < cells.size() && cells[last].tape == cells[first].tape) ++last;
        for (std::vector<double>& column : columns) column.assign(last - first, 0);
        for (const std::size_t axis : box_.axes)
            for (std::size_t i = first; i < last; ++i)
                columns[axis][i - first] = box_.cell.low[axis] + cell_size(level) * (cells[i].at[axis] + 0.5);
        values.resize(last - first);
        const double* points[] = {columns[0].data(), columns[1].data(), columns[2].data()};
        vm_.values(*cells[first].tape, points, values.size(), values.data());
        if (std::any_of(values.begin(), values.end(), [](double v) { return v > 0; })) return true;
    }
    return false;
}

std::vector<SampleIndex> BlendSearch::changes_in(const std::vector<OpenCell>& cells, int level, bool all) {
    std::size_t a_cell = 1;
    for (std::size_t k = 0; k < box_.axes.size(); ++k) a_cell *= samples_a_cell;
    std::vector<SampleIndex> out, samples(a_cell);
    std::array<std::vector<double>, 3> columns;
    for (std::vector<double>& column : columns) column.resize(a_cell);
    std::vector<double> values(a_cell);
    const double* points[] = {columns[0].data(), columns[1].data(), columns[2].data()};
    sample_size_ = cell_size(level) / samples_a_cell;
    for (const OpenCell& cell : cells) {
        for (std::size_t n = 0; n < a_cell; ++n) {
            SampleIndex sample{};
            std::size_t rest = n;
            for (const std::size_t axis : box_.axes) {
                sample[axis] =
                    static_cast<std::uint16_t>(cell.at[axis] * samples_a_cell + rest % samples_a_cell);
                rest /= samples_a_cell;
            }
            const Vec3 p = place(sample);
            columns[0][n] = p.x;
            columns[1][n] = p.y;
            columns[2][n] = p.z;
            samples[n] = sample;
        }
        vm_.values(*cell.tape, points, a_cell, values.data());
        for (std::size_t n = 0; n < a_cell; ++n)
            if (values[n] > 0) out.push_back(samples[n]);
        if (!all && !out.empty()) break;
    }
    return out;
}

Vec3 BlendSearch::place(const SampleIndex& sample) const {
    std::array<double, 3> p{};
    for (const std::size_t axis : box_.axes)
        p[axis] = box_.cell.low[axis] + sample_size_ * (sample[axis] + 0.5);
    return {p[0], p[1], p[2]};
}

/// The operations on samples in the parts of these cells, about: four times those in the cells.
double BlendSearch::work_of(const std::vector<OpenCell>& cells) {
    double work = 0;
    for (const OpenCell& cell : cells) work += 4 * 64 * cost_of(*cell.tape);
    return work;
}

BlendMap BlendSearch::run(bool with_parts, const Job& job) {
    BlendMap out;
    std::vector<OpenCell> cells;
    if (!surely_no_change(*change_)) cells.push_back({{}, change_});
    int level = 0;
    for (;; ++level) {
        cells = judged(cells, level);
        if (job.cancelled()) return out;
        if (cells.empty()) {
            out.never_acts = true;
            return out;
        }
        if (level == levels || cells.size() > most_cells) break;
        if (!with_parts && level >= first_sampled && is_changed_at_middle(cells, level)) {
            out.acts = true;
            return out;
        }
        if (work_of(cells) > most_work) break;
        cells = children(cells, level + 1);
    }
    out.finest = samples_a_side(level);
    const std::vector<SampleIndex> changes = changes_in(cells, level, with_parts);
    out.acts = !changes.empty();
    if (!out.acts) return look_closer(std::move(cells), level, job);
    if (!with_parts) return out;
    out.parts = connected_parts(changes);
    const double least = smallest_part * static_cast<double>(out.parts[0].size());
    std::erase_if(out.parts, [&](const auto& part) {
        return part.size() < fewest_samples || static_cast<double>(part.size()) < least;
    });
    return out;
}

/// What cells in which no sample is changed hold after all.
BlendMap BlendSearch::look_closer(std::vector<OpenCell> cells, int level, const Job& job) {
    BlendMap out;
    out.finest = samples_a_side(level);
    while (level < deepest && cells.size() <= most_cells && work_of(cells) <= most_work && !job.cancelled()) {
        ++level;
        cells = judged(children(cells, level), level);
        out.never_acts = cells.empty();
        out.acts = !changes_in(cells, level, false).empty();
        out.finest = samples_a_side(level);
        if (out.never_acts || out.acts) break;
    }
    return out;
}

bool BlendSearch::touches_joint(const std::vector<SampleIndex>& part) {
    // first the cells of the part, then the samples in those that the joint may reach
    BoxLanes boxes;
    RangeLanes ranges;
    const auto near = [&](std::vector<SampleIndex> corners, std::uint32_t side) {
        std::vector<SampleIndex> reached;
        for (std::size_t first = 0; first < corners.size(); first += tile_lanes) {
            const std::size_t count = std::min<std::size_t>(tile_lanes, corners.size() - first);
            boxes.count = static_cast<int>(count);
            for (std::size_t i = 0; i < count; ++i) {
                std::array<double, 3> low{};
                for (const std::size_t axis : box_.axes)
                    low[axis] = box_.cell.low[axis] + sample_size_ * (corners[first + i][axis] - 1.0);
                set_lane(boxes, i, low, sample_size_ * (side + 2));
            }
            pruner_.ranges(joint_, boxes, ranges);
            for (std::size_t i = 0; i < count; ++i)
                if (has(ranges.can_be_inside, static_cast<int>(i))) reached.push_back(corners[first + i]);
        }
        return reached;
    };
    const auto corner = [](SampleIndex s) {
        for (std::uint16_t& k : s) k = static_cast<std::uint16_t>(k / samples_a_cell * samples_a_cell);
        return s;
    };
    std::vector<SampleIndex> corners;
    for (const SampleIndex& sample : part) corners.push_back(corner(sample));
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    const std::vector<SampleIndex> reached = near(std::move(corners), samples_a_cell);
    std::vector<SampleIndex> samples;
    for (const SampleIndex& sample : part)
        if (std::binary_search(reached.begin(), reached.end(), corner(sample))) samples.push_back(sample);
    return !near(std::move(samples), 1).empty();
}

Vec3 BlendSearch::most_changed(const std::vector<SampleIndex>& part) {
    const std::size_t step = 1 + part.size() / most_compared;
    std::array<std::vector<double>, 3> columns;
    for (std::size_t i = 0; i < part.size(); i += step) {
        const Vec3 p = place(part[i]);
        columns[0].push_back(p.x);
        columns[1].push_back(p.y);
        columns[2].push_back(p.z);
    }
    std::vector<double> values(columns[0].size());
    const double* points[] = {columns[0].data(), columns[1].data(), columns[2].data()};
    vm_.values(*change_, points, values.size(), values.data());
    const auto most =
        static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
    return {columns[0][most], columns[1][most], columns[2][most]};
}

}  // namespace frep::measuring
