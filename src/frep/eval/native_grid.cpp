// Implementation of native_grid.h. A table of a set of axes has, for each vector along the lowest axis of the
// set, one vector of each value kept; along the other axis of the set it repeats. Read along another axis
// than its lowest one, a value is a single number for all lanes.
#if defined(FREP_HAS_JIT)

#include "frep/eval/native_grid.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "frep/base/result.h"

namespace frep::native {
namespace {

constexpr std::size_t whole_set = axis_sets - 1;
/// Pointers of the functions: coordinates x, y, z; tables by set 1..6; out.
constexpr std::uint32_t out_pointer = 9;
constexpr std::uint32_t table_pointer(std::size_t set) { return static_cast<std::uint32_t>(2 + set); }
constexpr std::size_t lowest_axis(std::size_t set) {
    return static_cast<std::size_t>(__builtin_ctz(static_cast<unsigned>(set)));
}
/// Bytes of tables that a part may have: within the second cache.
constexpr std::size_t table_limit = 192 << 10;
constexpr std::size_t most_vectors = 16, most_rows = 72;

}  // namespace

template <class Real>
Helpers helpers_for(const std::vector<CallContext>& calls) {
    Helpers helpers;
    constexpr bool single = sizeof(Real) == 4;
    helpers.patch1 = single ? &patch_floats_1 : &patch_doubles_1;
    helpers.patch2 = single ? &patch_floats_2 : &patch_doubles_2;
    helpers.call = single ? &call_on_floats : &call_on_doubles;
    for (const CallContext& context : calls) helpers.contexts.push_back(&context);
    return helpers;
}

template Helpers helpers_for<double>(const std::vector<CallContext>&);
template Helpers helpers_for<float>(const std::vector<CallContext>&);

/// A part of a grid, with its tables.
template <class Real>
struct GridCode<Real>::Part {
    std::array<std::size_t, 3> counts{};   ///< columns, rows, layers
    std::array<std::size_t, 3> vectors{};  ///< of each axis
    std::array<const Real*, 3> at{};       ///< coordinates, padded to whole vectors
    std::array<Real*, axis_sets> table{};
    std::array<void*, out_pointer + 1> pointers{};
    bool overlap = false;  ///< what is written past the end of a row is overwritten by the next row
    Real* row = nullptr;   ///< a row that does not end with a whole vector goes here first
    void* workspace = nullptr;
};

template <class Real>
std::vector<std::uint8_t> GridCode<Real>::sets_of(const StepList& list,
                                                  const std::vector<ValueId>& coordinates) const {
    std::vector<std::uint8_t> sets(list.steps().size(), 0);
    for (std::size_t i = 0; i < coordinates.size(); ++i)
        sets[coordinates[i]] = static_cast<std::uint8_t>(1u << i);
    for (std::size_t v = 0; v < sets.size(); ++v)
        for (const ValueId in : list.operands_of(list.steps()[v])) sets[v] |= sets[in];
    return sets;
}

/// Kept are values that the function of another set reads.
template <class Real>
void GridCode<Real>::choose_tables(const Translation& made, const std::vector<std::uint8_t>& sets) {
    const auto& steps = made.list.steps();
    std::vector<bool> live(steps.size(), false), kept(steps.size(), false);
    live[made.root] = true;
    kept[made.root] = sets[made.root] != whole_set;
    for (std::size_t v = steps.size(); v-- > 0;) {
        if (!live[v]) continue;
        // Masks have no tables: they are computed again from their operands where they are used.
        const bool again = is_mask(steps[v].op) && kept[v];
        for (const ValueId in : made.list.operands_of(steps[v])) {
            live[in] = true;
            if (again || sets[in] != sets[v]) kept[in] = true;
        }
    }
    for (ValueId v = 0; v < steps.size(); ++v) {
        const bool in_table = kept[v] && sets[v] != 0 && sets[v] != whole_set && !is_mask(steps[v].op);
        if (in_table && steps[v].op != StepOp::input) tables_[sets[v]].push_back(v);
    }
}

template <class Real>
FunctionPlan GridCode<Real>::plan_for(const Translation& made, std::uint32_t set) const {
    const auto bytes = static_cast<std::int32_t>(lanes_ * sizeof(Real));
    const std::size_t axis = lowest_axis(set);
    FunctionPlan plan;
    plan.strides.assign(out_pointer + 1, 0);
    for (std::size_t i = 0; i < made.coordinates.size(); ++i) {
        const bool along = i == axis;
        plan.sources.push_back({made.coordinates[i], !along, static_cast<std::uint32_t>(i), 0});
        if (along) plan.strides[i] = bytes;
    }
    for (std::uint32_t from = 1; from < whole_set; ++from) {
        if ((from & set) != from || from == set) continue;
        const bool along = (from >> axis & 1) != 0;
        for (std::size_t k = 0; k < tables_[from].size(); ++k)
            plan.sources.push_back(
                {tables_[from][k], !along, table_pointer(from), static_cast<std::int32_t>(k) * bytes});
        if (along)
            plan.strides[table_pointer(from)] = static_cast<std::int32_t>(tables_[from].size()) * bytes;
    }
    if (set == whole_set) {
        plan.targets.push_back({made.root, out_pointer, 0});
        plan.strides[out_pointer] = bytes;
        return plan;
    }
    for (std::size_t k = 0; k < tables_[set].size(); ++k)
        plan.targets.push_back({tables_[set][k], table_pointer(set), static_cast<std::int32_t>(k) * bytes});
    plan.strides[table_pointer(set)] = static_cast<std::int32_t>(tables_[set].size()) * bytes;
    return plan;
}

template <class Real>
bool GridCode<Real>::build(const ClauseTape& tape, Isa isa, std::span<const math::Interval> domain) {
    FREP_CHECK(tape.data->coordinates <= 3);
    lanes_ = (isa == Isa::avx512 ? 64 : 32) / sizeof(Real);
    lane_bits_ = static_cast<unsigned>(std::countr_zero(lanes_));
    Translation made = translate(tape, sizeof(Real) == 4, isa == Isa::avx512, domain);
    calls_ = std::move(made.calls);
    const auto sets = sets_of(made.list, made.coordinates);
    choose_tables(made, sets);
    CodeWriter writer(made.list, isa, helpers_for<Real>(calls_));
    std::vector<std::uint32_t> written;
    for (std::uint32_t set = 1; set < axis_sets; ++set) {
        if (set != whole_set && tables_[set].empty()) continue;
        writer.add(plan_for(made, set));
        written.push_back(set);
    }
    std::vector<std::uint8_t> code;
    std::vector<std::size_t> offsets;
    if (!writer.finish(code, offsets)) return false;
    memory_ = CodeMemory(code);
    if (!memory_.data()) return false;
    for (std::size_t i = 0; i < written.size(); ++i)
        functions_[written[i]] =
            reinterpret_cast<NativeFunction>(reinterpret_cast<std::uintptr_t>(memory_.data() + offsets[i]));
    workspace_ = (writer.workspace() + 63) / 64 * 64;
    return true;
}

/// Vectors of the table of a set.
template <class Real>
std::size_t GridCode<Real>::vectors_of(const Part& part, std::size_t set) const {
    std::size_t vectors = part.vectors[lowest_axis(set)];
    for (std::size_t axis = lowest_axis(set) + 1; axis < 3; ++axis)
        if ((set >> axis & 1) != 0) vectors *= part.counts[axis];
    return vectors * tables_[set].size();
}
template <class Real>
std::size_t GridCode<Real>::table_vectors(const Part& part) const {
    std::size_t sum = 0;
    for (std::size_t set = 1; set < whole_set; ++set) sum += vectors_of(part, set);
    return sum;
}

/// Makes a part small enough for its tables; counts are those of the whole grid before.
template <class Real>
void GridCode<Real>::choose_part(Part& part) const {
    const auto limit = [this](std::size_t count, std::size_t vectors) {
        return std::min(count, vectors * lanes_);
    };
    std::size_t x = most_vectors, rest = most_rows;
    const std::array<std::size_t, 3> whole = part.counts;
    for (;;) {
        part.counts = {limit(whole[0], x), std::min(whole[1], rest), std::min(whole[2], rest)};
        for (std::size_t axis = 0; axis < 3; ++axis)
            part.vectors[axis] = (part.counts[axis] + lanes_ - 1) / lanes_;
        if (table_vectors(part) * lanes_ * sizeof(Real) <= table_limit || (x == 1 && rest == 1)) return;
        if (x > 4 || rest == 1) {
            x /= 2;
        } else {
            rest /= 2;
        }
    }
}

/// Pointers for one run of the function of a set: row y and layer z of the part.
template <class Real>
void GridCode<Real>::point_at(Part& part, std::size_t set, std::size_t y, std::size_t z) const {
    const std::array<std::size_t, 3> place = {0, (set & 1) != 0 ? y : 0, (set & 3) != 0 ? z : 0};
    for (std::size_t axis = 0; axis < 3; ++axis)
        part.pointers[axis] = const_cast<Real*>(part.at[axis] + place[axis]);
    for (std::size_t from = 1; from < whole_set; ++from) {
        if ((from & set) != from || tables_[from].empty()) continue;
        const std::size_t lowest = lowest_axis(from), kept = tables_[from].size();
        std::size_t row = 0;  // along the other axis of the set
        if (from == 3) row = y;
        if (from == 5 || from == 6) row = z;
        const std::size_t along = place[lowest];
        Real* const begin = part.table[from] + row * part.vectors[lowest] * kept * lanes_;
        part.pointers[table_pointer(from)] =
            begin + (along >> lane_bits_) * kept * lanes_ + (along & (lanes_ - 1));
    }
}

template <class Real>
void GridCode<Real>::call(std::size_t set, Part& part, std::size_t vectors) const {
    functions_[set](part.pointers.data(), vectors, part.workspace);
}

template <class Real>
void GridCode<Real>::fill_tables(Part& part) const {
    for (const std::size_t set :
         {std::size_t{1}, std::size_t{2}, std::size_t{4}, std::size_t{3}, std::size_t{5}, std::size_t{6}}) {
        if (tables_[set].empty()) continue;
        const std::size_t lowest = lowest_axis(set);
        const std::size_t rows = set == 3 ? part.counts[1] : set == 5 || set == 6 ? part.counts[2] : 1;
        for (std::size_t i = 0; i < rows; ++i) {
            point_at(part, set, set == 3 ? i : 0, set == 3 ? 0 : i);
            call(set, part, part.vectors[lowest]);
        }
    }
}

template <class Real>
void GridCode<Real>::run_part(const NativeGrid<Real>& grid, Part& part) const {
    fill_tables(part);
    const bool whole = part.counts[0] % lanes_ == 0;
    const std::size_t last_y = part.counts[1] - 1, last_z = part.counts[2] - 1;
    for (std::size_t z = 0; z < part.counts[2]; ++z) {
        for (std::size_t y = 0; y < part.counts[1]; ++y) {
            Real* const out = grid.out + z * grid.layer_stride + y * grid.row_stride;
            point_at(part, whole_set, y, z);
            const bool direct = whole || (part.overlap && (y < last_y || z < last_z));
            part.pointers[out_pointer] = direct ? out : part.row;
            call(whole_set, part, part.vectors[0]);
            if (!direct) std::copy_n(part.row, part.counts[0], out);
        }
    }
}

/// Places the coordinates, a row, the workspace and the tables of a part in memory.
template <class Real>
void GridCode<Real>::place_part(Part& part, const NativeGrid<Real>& grid, Real* next) const {
    const std::array<std::span<const Real>, 3> axes = {grid.x, grid.y, grid.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t count = axes[axis].size();
        part.counts[axis] = count;
        part.vectors[axis] = (count + lanes_ - 1) / lanes_;
        part.at[axis] = next;
        for (std::size_t i = 0; i < part.vectors[axis] * lanes_; ++i)
            *next++ = axes[axis][std::min(i, count - 1)];
    }
    part.row = next;
    next += part.vectors[0] * lanes_;
    part.workspace = next;
    next += workspace_ / sizeof(Real);
    for (std::size_t set = 1; set < whole_set; ++set) {
        part.table[set] = next;
        next += vectors_of(part, set) * lanes_;
    }
}

template <class Real>
void GridCode<Real>::run(const NativeGrid<Real>& grid) const {
    if (grid.x.empty() || grid.y.empty() || grid.z.empty()) return;
    Part largest;
    largest.counts = {grid.x.size(), grid.y.size(), grid.z.size()};
    choose_part(largest);
    std::size_t numbers = table_vectors(largest) * lanes_ + (workspace_ + 64) / sizeof(Real);
    for (const std::size_t vectors : largest.vectors) numbers += vectors * lanes_;
    numbers += largest.vectors[0] * lanes_;
    thread_local std::vector<Real> memory;  // kept for the next grid: fresh pages are dear
    if (memory.size() < numbers) memory.resize(numbers);
    void* raw = memory.data();
    std::size_t space = memory.size() * sizeof(Real);
    Real* const begin = static_cast<Real*>(std::align(64, 64, raw, space));
    const auto some = [](std::span<const Real> axis, std::size_t first, std::size_t most) {
        return axis.subspan(first, std::min(most, axis.size() - first));
    };
    const auto& [columns, rows, layers] = largest.counts;
    for (std::size_t z = 0; z < grid.z.size(); z += layers) {
        for (std::size_t y = 0; y < grid.y.size(); y += rows) {
            for (std::size_t x = 0; x < grid.x.size(); x += columns) {
                NativeGrid<Real> there = grid;
                there.x = some(grid.x, x, columns);
                there.y = some(grid.y, y, rows);
                there.z = some(grid.z, z, layers);
                there.out = grid.out + x + y * grid.row_stride + z * grid.layer_stride;
                Part part;
                place_part(part, there, begin);
                part.overlap = columns == grid.x.size() && rows == grid.y.size() &&
                               grid.row_stride == columns && grid.layer_stride == columns * rows &&
                               part.vectors[0] * lanes_ - columns <= columns;
                run_part(there, part);
            }
        }
    }
}

template class GridCode<double>;
template class GridCode<float>;

}  // namespace frep::native

#endif  // FREP_HAS_JIT
