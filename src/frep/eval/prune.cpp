// Implementation of prune.h: the workspace, and the order of the passes.
#include "frep/eval/prune.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "frep/base/result.h"
#include "frep/eval/float_control.h"
#include "frep/eval/prune_emit.h"
#include "frep/eval/prune_general.h"
#include "frep/eval/tile_kernels.h"
#include "frep/field/kernels/noise.h"

namespace frep {
namespace {

// tile_forward.h reads clauses by these places
static_assert(sizeof(Clause) == 24 && offsetof(Clause, op) == 0 && offsetof(Clause, listed) == 1 &&
              offsetof(Clause, count) == 4 && offsetof(Clause, out) == 8 && offsetof(Clause, in) == 12);

/// A cut tape is worth having when one clause in so many of its parent's is gone or became simpler.
constexpr std::size_t least_saving = 16;

const tile::Kernels& kernels_for(Isa isa) {
#if defined(__x86_64__)
    if (isa == Isa::avx512) return tile::avx512::kernels();
    if (isa == Isa::avx2) return tile::avx2::kernels();
#endif
    static_cast<void>(isa);
    return tile::sse2::kernels();
}

/// Rows are large and their bounds are written before they are read: no vector, which would fill them.
class Rows {
  public:
    tile::Row* data() const { return rows_.get(); }
    /// Room for `count`; what was there is lost when it grows.
    bool grow(std::size_t count) {
        if (count <= size_) return false;
        size_ = count + count / 4;
        rows_.reset(new tile::Row[size_]);
        return true;
    }

  private:
    std::unique_ptr<tile::Row[]> rows_;
    std::size_t size_ = 0;
};

/// Bounds as binary32, outward; as rounded_down() and rounded_up(), without a branch.
void round_outward(const double* lo, const double* hi, tile::Row& row) {
    constexpr float largest = std::numeric_limits<float>::max();
    constexpr float least_number = std::numeric_limits<float>::denorm_min();
    for (int k = 0; k < tile_lanes; ++k) {
        const auto low = static_cast<float>(lo[k]), high = static_cast<float>(hi[k]);
        const float below = low - (__builtin_fabsf(low) * 0x1p-23f + least_number);
        const float above = high + (__builtin_fabsf(high) * 0x1p-23f + least_number);
        const float bottom = static_cast<double>(low) > lo[k] ? below : low;
        const float top = static_cast<double>(high) < hi[k] ? above : high;
        row.lo[k] = bottom > largest ? largest : bottom;
        row.hi[k] = top < -largest ? -largest : top;
    }
}

/// The table of the noise, its gradients as binary32.
tile::NoiseLattice noise_table() {
    static const auto gradients = [] {
        std::array<float, 3 * 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] = static_cast<float>(kernels::noise_detail::lattice().gradient[i / 3][i % 3]);
        return table;
    }();
    return {kernels::noise_detail::lattice().permutation, gradients.data()};
}

}  // namespace

struct Pruner::Workspace {
    const tile::Kernels* kernels = nullptr;
    std::shared_ptr<const ClauseData> data;  ///< whose constants are in the rows
    Rows rows;
    std::vector<tile::Block> blocks;
    std::vector<std::uint32_t> flags;
    std::vector<tile::Wanted> wanted;
    std::vector<tile::Record> records;
    GeneralRange general;
    CutEmitter emitter;
    const ClauseTape* tape = nullptr;  ///< of the pass that runs
    std::size_t operations = 0;
    float tolerance = 0;  ///< as in tile::Job
    float rounding = 0;

    void prepare(const ClauseTape& of);
    void fill_coordinates(const BoxLanes& boxes);
    tile::Job job();
    void run_forward(const ClauseTape& of, const BoxLanes& boxes, RangeLanes& out);
    std::size_t run_reverse(unsigned lanes, bool value);
    void emit_groups(Purpose purpose, unsigned lanes, std::size_t count, CutResult& out);
    static void general_clause(void* self, std::uint32_t clause, unsigned lanes);
};

void Pruner::Workspace::prepare(const ClauseTape& of) {
    tape = &of;
    const bool moved = rows.grow(of.rows);
    if (flags.size() < of.rows) {
        flags.resize(of.rows);
        wanted.resize(of.rows);
    }
    if (records.size() < of.clauses.size()) records.resize(of.clauses.size());
    if (!moved && data == of.data) return;
    data = of.data;
    blocks.clear();
    for (const std::span<const double> block : data->blocks) blocks.push_back({block.data(), block.size()});
    // the clauses clear what is wanted of their rows; for constants and coordinates nobody reads it
    std::fill(wanted.begin(), wanted.end(), tile::Wanted{});
    for (std::size_t i = 0; i < data->constants.size(); ++i) {
        const double c = data->constants[i];
        const bool none = c != c;
        flags[i] = none ? 0xffffffffu : 0u;
        const float lo = none ? -std::numeric_limits<float>::infinity() : rounded_down(c);
        const float hi = none ? std::numeric_limits<float>::infinity() : rounded_up(c);
        for (int k = 0; k < tile_lanes; ++k) {
            rows.data()[i].lo[k] = lo;
            rows.data()[i].hi[k] = hi;
        }
    }
}

void Pruner::Workspace::fill_coordinates(const BoxLanes& boxes) {
    for (int i = 0; i < data->coordinates; ++i) {
        const RowNumber number = data->coordinate_row(i);
        flags[number] = 0;
        tile::Row& row = rows.data()[number];
        const auto axis = static_cast<std::size_t>(i);
        round_outward(boxes.lo[axis].data(), boxes.hi[axis].data(), row);
        // lanes without a box repeat the first
        for (int k = boxes.count; k < tile_lanes; ++k) {
            row.lo[k] = row.lo[0];
            row.hi[k] = row.hi[0];
        }
    }
}

void Pruner::Workspace::general_clause(void* self, std::uint32_t clause, unsigned lanes) {
    auto& w = *static_cast<Workspace*>(self);
    general_range(*w.tape, clause, lanes, w.rows.data(), w.flags.data(), w.general);
}

tile::Job Pruner::Workspace::job() {
    tile::Job job{};
    job.clauses = tape->clauses.data();
    job.clause_count = static_cast<std::uint32_t>(tape->clauses.size());
    job.operands = tape->operands.data();
    job.blocks = blocks.data();
    job.lattice = noise_table();
    job.constants = static_cast<std::uint32_t>(data->constants.size());
    job.first_value = data->first_value_row();
    job.rows = rows.data();
    job.flags = flags.data();
    job.general = general_clause;
    job.self = this;
    job.wanted = wanted.data();
    job.records = records.data();
    job.tolerance = tolerance;
    job.rounding = &rounding;
    return job;
}

void Pruner::Workspace::run_forward(const ClauseTape& of, const BoxLanes& boxes, RangeLanes& out) {
    FREP_CHECK(boxes.count >= 1 && boxes.count <= tile_lanes);
    prepare(of);
    fill_coordinates(boxes);
    kernels->forward(job());
    operations += of.clauses.size() * static_cast<std::size_t>(boxes.count);
    const tile::Row& root = rows.data()[of.root];
    const std::uint32_t flag = flags[of.root];
    out = {};
    for (int k = 0; k < boxes.count; ++k) {
        const auto lane = static_cast<std::size_t>(k);
        out.lo[lane] = root.lo[k];
        out.hi[lane] = root.hi[k];
        const std::uint32_t undefined = flag >> k & 1u, nowhere = flag >> (16 + k) & 1u;
        const auto bit = static_cast<std::uint16_t>(1u << k);
        if (nowhere == 0 && root.hi[k] >= 0) out.can_be_inside |= bit;
        if (nowhere != 0 || undefined != 0 || root.lo[k] < 0) out.can_be_outside |= bit;
        if (undefined != 0 || nowhere != 0) out.can_be_undefined |= bit;
    }
}

std::size_t Pruner::Workspace::run_reverse(unsigned lanes, bool value) {
    tile::Wanted& root = wanted[tape->root];
    root = {};
    root.live = static_cast<std::uint16_t>(lanes);
    root.value = value ? root.live : std::uint16_t{0};
    root.gain = 1;
    return kernels->reverse(job());
}

void Pruner::Workspace::emit_groups(Purpose purpose, unsigned lanes, std::size_t count, CutResult& out) {
    std::array<std::uint16_t, tile_lanes> same{};
    std::array<std::uint32_t, tile_lanes> estimate{};
    const bool set_operations = purpose == Purpose::occupancy;
    kernels->agree(records.data(), count, lanes, set_operations, same.data(), estimate.data());
    const std::span<const tile::Record> found(records.data(), count);
    const std::size_t before = tape->clauses.size(), worth = before - before / least_saving;
    for (unsigned rest = lanes; rest != 0;) {
        const auto k = static_cast<std::size_t>(__builtin_ctz(rest));
        const unsigned group = same[k] & rest;
        rest &= ~group;
        std::int8_t number = CutResult::whole;
        if (estimate[k] < worth) {
            const auto next = static_cast<std::size_t>(out.tape_count);
            if (out.tapes.size() <= next) out.tapes.resize(next + 1);
            emit_cut_tape(*tape, found, group, set_operations, emitter, out.tapes[next]);
            number = static_cast<std::int8_t>(out.tape_count++);
        }
        for (std::size_t i = 0; i < tile_lanes; ++i)
            if (group >> i & 1u) out.tape_of[i] = number;
    }
}

Pruner::Pruner(Isa isa) : workspace_(std::make_unique<Workspace>()) {
    workspace_->kernels = &kernels_for(isa);
}
Pruner::~Pruner() = default;
Pruner::Pruner(Pruner&&) noexcept = default;
Pruner& Pruner::operator=(Pruner&&) noexcept = default;

void Pruner::ranges(const ClauseTape& tape, const BoxLanes& boxes, RangeLanes& out) {
    const FloatControl control;
    workspace_->run_forward(tape, boxes, out);
}

void Pruner::cut(const ClauseTape& tape, const BoxLanes& boxes, Purpose purpose, CutResult& out) {
    const FloatControl control;
    workspace_->run_forward(tape, boxes, out.ranges);
    out.tape_of.fill(CutResult::none);
    out.tape_count = 0;
    const bool value = purpose == Purpose::value;
    const unsigned lanes = value ? (1u << boxes.count) - 1u : out.ranges.open();
    if (lanes == 0) return;
    const std::size_t count = workspace_->run_reverse(lanes, value);
    workspace_->emit_groups(purpose, lanes, count, out);
}

double Pruner::cut_near(const ClauseTape& tape, const BoxLanes& boxes, double share, CutResult& out) {
    const FloatControl control;
    Workspace& w = *workspace_;
    w.run_forward(tape, boxes, out.ranges);
    out.tape_of.fill(CutResult::none);
    out.tape_count = 0;
    const unsigned lanes = out.ranges.open();
    if (lanes == 0) return 0;
    const auto is_sum = [](const Clause& clause) { return clause.op == Op::add || clause.op == Op::sub; };
    const auto sums = std::count_if(tape.clauses.begin(), tape.clauses.end(), is_sum);
    double width = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < tile_lanes; ++k)
        if ((lanes >> k & 1u) != 0)
            width = std::min(width, static_cast<double>(out.ranges.hi[k]) - out.ranges.lo[k]);
    const bool is_bounded = width <= std::numeric_limits<float>::max() && sums > 0;
    w.tolerance = is_bounded ? static_cast<float>(share * width / static_cast<double>(sums)) : 0;
    w.rounding = 0;
    const std::size_t count = w.run_reverse(lanes, false);
    w.emit_groups(Purpose::sign, lanes, count, out);
    const double terms = static_cast<double>(w.tolerance) * static_cast<double>(sums);
    w.tolerance = 0;
    return 1.001 * (terms + w.rounding);
}

std::size_t Pruner::tile_operations() const { return workspace_->operations; }

}  // namespace frep
