// Implementation of dual_block.h: samples and signs, crossings, normals and attributes there, and which cubes
// of cells may merge. The test for those is that of Ju, Losasso, Schaefer and Warren 2002, 5.2: all eight
// parts have one sheet at most, and so has the cube; the sign in the middle of each edge, of each face and of
// the cube is that of a corner of this edge, this face, the cube.
#include "frep/contour/dual_block.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <new>

#include "frep/contour/block.h"
#include "frep/contour/cell.h"
#include "frep/contour/dual_cell.h"

namespace frep::contouring {

namespace {

constexpr double outside_by_decree = -std::numeric_limits<double>::infinity();

void set_component(Vec3& v, std::size_t axis, double value) {
    (axis == 0 ? v.x : axis == 1 ? v.y : v.z) = value;
}

bool is_homogeneous(unsigned signs) { return signs == 0 || signs == 255; }

/// Calls visit(l) for all l with begin <= l < end, x fastest.
template <class Visit>
void for_each(const Lattice& begin, const Lattice& end, Visit visit) {
    Lattice l{};
    for (l[2] = begin[2]; l[2] < end[2]; ++l[2]) {
        for (l[1] = begin[1]; l[1] < end[1]; ++l[1]) {
            for (l[0] = begin[0]; l[0] < end[0]; ++l[0]) visit(l);
        }
    }
}

}  // namespace

void DualBlock::reset(std::uint64_t new_code) {
    code = new_code;
    edges = {};
    cell_set = {};
    mergeable = {};
    roots.clear();
    normals.clear();
    attributes.clear();
    cells.clear();
}

StoredBlock store(const DualBlock& block, std::pmr::memory_resource& memory) {
    void* const place = memory.allocate(sizeof(DualBlock), alignof(DualBlock));
    return StoredBlock(new (place) DualBlock{block.code,
                                             block.edges,
                                             block.cell_set,
                                             {block.roots, &memory},
                                             {block.normals, &memory},
                                             {block.attributes, &memory},
                                             {block.cells, &memory},
                                             block.mergeable,
                                             {},
                                             {},
                                             {},
                                             std::pmr::vector<double>(&memory),
                                             std::pmr::vector<DualBlock::Wish>(&memory),
                                             {}});
}

bool DualSampler::is_layer(const Lattice& l) const {
    for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t e = lo_[a] + l[a];
        if (e == 0 || e > grid_.cells[a] + 1) return true;
    }
    return false;
}

Vec3 DualSampler::point(const Lattice& l) const {
    return grid_.point(lo_[0] + l[0] - 1, lo_[1] + l[1] - 1, lo_[2] + l[2] - 1);
}

void DualSampler::place(std::uint64_t code) {
    const Lattice block = morton_decode(code);
    is_at_side_ = false;
    for (std::size_t a = 0; a < 3; ++a) {
        lo_[a] = block[a] * block_side;
        first_[a] = lo_[a] == 0 ? 1 : 0;
        const std::uint32_t end = grid_.cells[a] + 1 - lo_[a];  // the box's last sample
        last_[a] = end < block_side ? end : block_side;
        is_at_side_ = is_at_side_ || lo_[a] == 0 || end <= block_side;
    }
}

const DualBlock* DualSampler::sample(std::uint64_t code, const BlockFields& fields) {
    place(code);
    const bool is_crossed = take_values(code, fields.signs);
    look_between(code, fields);
    if (!is_crossed) return nullptr;
    work_.reset(code);
    collect_edges(work_);
    collect_cells(work_);
    if (work_.roots.empty() && work_.cells.empty()) return nullptr;
    finder_.find(fields.part, crossed_, found_);
    for (std::size_t i = 0; i < found_.size(); ++i) work_.roots[crossed_at_[i]] = found_[i].inside;
    take_normals(work_, fields.part);
    take_attributes(work_, fields.whole);
    if (options_.tolerance > 0) find_mergeable(work_);
    return &work_;
}

/// The values at the corners of the block's cells. False when there is no surface among them.
bool DualSampler::take_values(std::uint64_t code, SampledField& field) {
    std::array<std::uint32_t, 3> counts{};
    for (std::size_t a = 0; a < 3; ++a) counts[a] = last_[a] + 1 - first_[a];
    const std::size_t count = std::size_t{counts[0]} * counts[1] * counts[2];
    for (std::vector<double>* column : {&x_, &y_, &z_, &out_}) column->resize(count);
    std::array<double, side> row{};
    for (std::uint32_t x = 0; x < counts[0]; ++x) row[x] = grid_.coordinate(0, lo_[0] + first_[0] + x - 1);
    std::size_t at = 0;
    for (std::uint32_t z = first_[2]; z <= last_[2]; ++z) {
        const double pz = grid_.coordinate(2, lo_[2] + z - 1);
        for (std::uint32_t y = first_[1]; y <= last_[1]; ++y, at += counts[0]) {
            std::copy_n(row.data(), counts[0], &x_[at]);
            std::fill_n(&y_[at], counts[0], grid_.coordinate(1, lo_[1] + y - 1));
            std::fill_n(&z_[at], counts[0], pz);
        }
    }
    if (count == size) {
        field.values({x_, y_, z_}, values_);
    } else {
        field.values({x_, y_, z_}, out_);
        values_.fill(outside_by_decree);
        at = 0;
        for (std::uint32_t z = first_[2]; z <= last_[2]; ++z)
            for (std::uint32_t y = first_[1]; y <= last_[1]; ++y, at += counts[0])
                std::copy_n(&out_[at], counts[0], &values_[index({first_[0], y, z})]);
    }
    std::size_t inside = 0;
    bool is_defined = true;
    const double* value = values_.data();
    for (std::uint32_t& bits : rows_) {
        bits = 0;
        for (std::uint32_t x = 0; x < side; ++x, ++value) {
            bits |= std::uint32_t{*value >= 0} << x;
            is_defined = is_defined && *value == *value;
        }
        inside += bit_count(bits);
    }
    if (!is_defined || (is_at_side_ && inside > 0)) note_samples(code);
    return inside > 0 && (inside < count || (options_.cap && inside < size));
}

/// Counts the cells that hold what no sample shows.
void DualSampler::look_between(std::uint64_t code, const BlockFields& fields) {
    const SampleBlock block{grid_, values_, rows_, lo_, first_, last_};
    for (const std::uint32_t cell : thin_parts_.find(block, fields)) hidden.add(1, code, cell);
}

/// Counts the undefined samples of this block's own and notes inside samples at the sides of the box.
void DualSampler::note_samples(std::uint64_t code) {
    for_each(first_, {last_[0] + 1, last_[1] + 1, last_[2] + 1}, [&](const Lattice& l) {
        const double value = values_[index(l)];
        const bool own = l[0] < block_side && l[1] < block_side && l[2] < block_side;
        if (value != value && own) undefined.add(1, code, local_number(l));
        if (!(value >= 0)) return;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::uint32_t i = lo_[a] + l[a] - 1;
            if (i == 0) touches[2 * a] = true;
            if (i == grid_.cells[a]) touches[2 * a + 1] = true;
        }
    });
}

/// The own edges with different signs at their ends, in ascending order; with the layer only under the cap.
void DualSampler::collect_edges(DualBlock& block) {
    crossed_.clear();
    crossed_at_.clear();
    constexpr std::uint32_t own = (1u << block_side) - 1;
    for (std::uint32_t z = 0; z < block_side; ++z) {
        for (std::uint32_t y = 0; y < block_side; ++y) {
            const std::uint32_t* const row = &rows_[z * side + y];
            const std::array<std::uint32_t, 3> crossed{(row[0] ^ row[0] >> 1) & own, (row[0] ^ row[1]) & own,
                                                       (row[0] ^ row[side]) & own};
            for (std::uint32_t rest = crossed[0] | crossed[1] | crossed[2]; rest != 0; rest &= rest - 1) {
                const auto x = static_cast<std::uint32_t>(std::countr_zero(rest));
                for (std::size_t a = 0; a < 3; ++a)
                    if ((crossed[a] >> x & 1) != 0) add_edge(block, {x, y, z}, a);
            }
        }
    }
    block.edges.count();
}

void DualSampler::add_edge(DualBlock& block, const Lattice& lower, std::size_t axis) {
    Lattice upper = lower;
    ++upper[axis];
    const bool lower_is_inside = is_inside(lower);
    if (is_at_side_ && (is_layer(lower) || is_layer(upper))) {
        // The cap: the crossing is the inside sample, its normal that of the side.
        if (!options_.cap) return;
        block.edges.insert(edge_number(lower, axis));
        block.roots.push_back(lower_is_inside ? 0 : 1);
        Vec3 normal{0, 0, 0};
        set_component(normal, axis, lower_is_inside ? 1 : -1);
        block.normals.push_back(normal);
        return;
    }
    CrossedEdge edge;
    edge.lower = point(lower);
    edge.axis = static_cast<std::uint8_t>(axis);
    const std::uint32_t i = lo_[axis] + lower[axis] - 1;
    edge.length =
        grid_.coordinate(static_cast<int>(axis), i + 1) - grid_.coordinate(static_cast<int>(axis), i);
    const double* const value = &values_[index(lower)];
    const std::uint32_t step = stride[axis];
    edge.lower_value = *value;
    edge.upper_value = value[step];
    predict(edge, lower[axis] > 0 ? *(value - step) : outside_by_decree,
            upper[axis] < block_side ? value[2 * step] : outside_by_decree);
    crossed_.push_back(edge);
    crossed_at_.push_back(static_cast<std::uint32_t>(block.roots.size()));
    block.edges.insert(edge_number(lower, axis));
    block.roots.push_back(0);
    block.normals.push_back({0, 0, 0});
}

/// Normals from the gradients at the inside ends. A wall, where F ends without a zero, has nothing to do with
/// the gradient; its normals stay unknown.
void DualSampler::take_normals(DualBlock& block, SampledField& part) {
    const std::size_t count = crossed_.size();
    for (std::vector<double>* v : {&x_, &y_, &z_, &out_, &gx_, &gy_, &gz_}) v->resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = point_on(crossed_[i], found_[i].inside);
        x_[i] = p.x;
        y_[i] = p.y;
        z_[i] = p.z;
    }
    if (count == 0) return;
    part.gradients({x_, y_, z_}, out_, {gx_, gy_, gz_});
    for (std::size_t i = 0; i < count; ++i) {
        if (found_[i].is_wall) continue;
        block.normals[crossed_at_[i]] = outward_normal({gx_[i], gy_[i], gz_[i]});
    }
}

/// Attributes at the inside ends, where F >= 0: library functions that set colors write only there.
void DualSampler::take_attributes(DualBlock& block, SampledField& field) {
    const std::size_t wanted = options_.attributes, count = block.roots.size();
    if (wanted == 0 || count == 0) return;
    x_.clear();
    y_.clear();
    z_.clear();
    std::size_t next = 0;
    for_each({0, 0, 0}, {block_side, block_side, block_side}, [&](const Lattice& l) {
        for (std::size_t a = 0; a < 3; ++a) {
            if (!block.edges.has(edge_number(l, a))) continue;
            Vec3 p;
            if (next < crossed_at_.size() && crossed_at_[next] == x_.size()) {
                p = point_on(crossed_[next], found_[next].inside);
                ++next;
            } else {
                Lattice at = l;
                at[a] += is_inside(l) ? 0u : 1u;
                p = point(at);
            }
            x_.push_back(p.x);
            y_.push_back(p.y);
            z_.push_back(p.z);
        }
    });
    columns_.resize(wanted * count);
    std::vector<std::span<double>> columns;
    for (std::size_t k = 0; k < wanted; ++k) columns.emplace_back(&columns_[k * count], count);
    field.attributes({x_, y_, z_}, columns);
    block.attributes.resize(wanted * count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < wanted; ++k) block.attributes[i * wanted + k] = columns[k][i];
    }
}

unsigned DualSampler::signs_at(const Lattice& lower, std::uint32_t step) const {
    unsigned signs = 0;
    for (unsigned c = 0; c < 8; ++c) {
        const auto& o = corner_offsets[c];
        const bool sign = is_inside({lower[0] + o[0] * step, lower[1] + o[1] * step, lower[2] + o[2] * step});
        signs |= static_cast<unsigned>(sign) << c;
    }
    return signs;
}

/// The own cells that the surface crosses; those of the layer only under the cap.
void DualSampler::collect_cells(DualBlock& block) {
    Lattice begin{}, end{block_side, block_side, block_side};
    for (std::size_t a = 0; a < 3 && !options_.cap; ++a) {
        begin[a] = first_[a];
        end[a] = last_[a] < block_side ? last_[a] : block_side;
    }
    const std::uint32_t own = (1u << end[0]) - (1u << begin[0]);
    const auto& patterns = cell_patterns();
    for (std::uint32_t z = begin[2]; z < end[2]; ++z) {
        for (std::uint32_t y = begin[1]; y < end[1]; ++y) {
            const std::uint32_t* const row = &rows_[z * side + y];
            const std::uint32_t some = row[0] | row[1] | row[side] | row[side + 1];
            const std::uint32_t all = row[0] & row[1] & row[side] & row[side + 1];
            for (std::uint32_t rest = (some | some >> 1) & ~(all & all >> 1) & own; rest != 0;
                 rest &= rest - 1) {
                const Lattice l{static_cast<std::uint32_t>(std::countr_zero(rest)), y, z};
                DualCell cell;
                cell.number = static_cast<std::uint16_t>(local_number(l));
                cell.signs = static_cast<std::uint8_t>(signs_at(l, 1));
                if (!patterns[cell.signs].is_simple()) tight.add(1, block.code, local_number(l));
                block.cell_set.insert(cell.number);
                block.cells.push_back(cell);
            }
        }
    }
    block.cell_set.count();
}

/// Whether the 27 samples at distances `step` pass the test of the header comment.
bool DualSampler::keeps_topology(const Lattice& lower, std::uint32_t step) const {
    const unsigned corners = signs_at(lower, 2 * step);
    if (!is_homogeneous(corners) && !cell_pattern(corners).is_simple()) return false;
    for (std::uint32_t code = 0; code < 27; ++code) {
        const std::array<std::uint32_t, 3> digit{code % 3, code / 3 % 3, code / 9};
        const auto sign = [&](unsigned bits) {
            Lattice l = lower;
            for (std::size_t a = 0; a < 3; ++a) {
                const std::uint32_t d = digit[a] == 1 ? 2 * (bits >> a & 1u) : digit[a];
                l[a] += d * step;
            }
            return is_inside(l);
        };
        const bool here =
            is_inside({lower[0] + digit[0] * step, lower[1] + digit[1] * step, lower[2] + digit[2] * step});
        bool agrees = false;
        for (unsigned bits = 0; bits < 8 && !agrees; ++bits) agrees = sign(bits) == here;
        if (!agrees) return false;
    }
    return true;
}

void DualSampler::find_mergeable(DualBlock& block) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t half = 1u << k, count = block_side / (2 * half);
        for_each({0, 0, 0}, {count, count, count}, [&](const Lattice& cube) {
            const Lattice lower{cube[0] * 2 * half, cube[1] * 2 * half, cube[2] * 2 * half};
            for (std::size_t a = 0; a < 3 && !options_.cap; ++a) {
                if (lower[a] < first_[a] || lower[a] + 2 * half > last_[a]) return;
            }
            for (std::uint32_t c = 0; c < 8; ++c) {
                const Lattice part{cube[0] * 2 + (c & 1), cube[1] * 2 + (c >> 1 & 1), cube[2] * 2 + (c >> 2)};
                if (k == 0) {
                    const unsigned signs = signs_at(part, 1);
                    if (!is_homogeneous(signs) && !cell_pattern(signs).is_simple()) return;
                } else {
                    const std::uint32_t i = (part[2] * 2 * count + part[1]) * 2 * count + part[0];
                    if (!(block.mergeable[k - 1] >> i & 1)) return;
                }
            }
            if (!keeps_topology(lower, half)) return;
            block.mergeable[k] |= std::uint64_t{1} << ((cube[2] * count + cube[1]) * count + cube[0]);
        });
    }
}

}  // namespace frep::contouring
