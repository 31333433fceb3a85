// Memory, batches and the choice of the instruction set for batch_vm.h.
#include "frep/eval/batch_vm.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "frep/eval/batch_frame.h"
#include "frep/eval/batch_other.h"
#include "frep/eval/float_control.h"

namespace frep {
namespace {

/// Bytes of a batch that shall lie in the first cache, and the points of one.
constexpr std::size_t cache_bytes = 24 << 10;
constexpr std::size_t least_points = 32, most_points = 512;

template <class Real>
batch::Code<Real> code_for(Isa isa);
template <>
batch::Code<double> code_for(Isa isa) {
    const auto code = isa == Isa::avx512 ? batch::doubles_avx512()
                      : isa == Isa::avx2 ? batch::doubles_avx2()
                                         : batch::doubles_sse2();
    return code.values ? code : batch::doubles_sse2();
}
template <>
batch::Code<float> code_for(Isa isa) {
    const auto code = isa == Isa::avx512 ? batch::floats_avx512()
                      : isa == Isa::avx2 ? batch::floats_avx2()
                                         : batch::floats_sse2();
    return code.values ? code : batch::floats_sse2();
}

/// Numbers that begin at a cache line.
template <class Real>
class Memory {
  public:
    /// At least `count` numbers; what was there before is lost when it grows.
    Real* at_least(std::size_t count) {
        const std::size_t lines = (count * sizeof(Real) + sizeof(Line) - 1) / sizeof(Line);
        if (lines_.size() < lines) lines_ = std::vector<Line>(lines + lines / 2);
        return reinterpret_cast<Real*>(lines_.data());
    }

  private:
    struct alignas(64) Line {
        unsigned char bytes[64];
    };
    std::vector<Line> lines_;
};

}  // namespace

template <class Real>
class BatchVm<Real>::Machine {
  public:
    Machine() : code_(code_for<Real>(machine_isa())) { frame_.owner = this; }

    void values(const ClauseTape& tape, std::span<const Real* const> coordinates, std::size_t count,
                Real* out) {
        const FloatControl control;
        prepare(tape, 1);
        frame_.other = [](void* owner, const Clause& clause, Real* to) {
            Machine& machine = *static_cast<Machine*>(owner);
            machine.other_.values(machine.call_of(clause, to));
        };
        const std::size_t batch = batch_points(tape, count, 1);
        lay_out(tape, batch);
        for (std::size_t start = 0; start < count; start += batch)
            values_of(tape, coordinates, start, std::min(batch, count - start), out + start);
    }

    void gradients(const ClauseTape& tape, std::span<const Real* const> coordinates, std::size_t count,
                   Real* values, std::span<Real* const> partials) {
        const FloatControl control;
        prepare(tape, 4);
        frame_.other = [](void* owner, const Clause& clause, Real* to) {
            Machine& machine = *static_cast<Machine*>(owner);
            machine.other_.gradients(machine.call_of(clause, to));
        };
        const std::size_t batch = batch_points(tape, count, 4);
        lay_out(tape, 4 * batch);
        for (std::size_t start = 0; start < count; start += batch)
            for (std::size_t first = 0; first == 0 || first < partials.size(); first += 3)
                gradients_of(tape, coordinates, {start, std::min(batch, count - start), first}, values,
                             partials);
    }

  private:
    /// What stands in the rows below the first value row.
    struct Leaves {
        std::shared_ptr<const ClauseData> data;  ///< whose constants they are
        Memory<Real> constants;
        std::vector<const Real*> rows;
    };
    struct Pass {
        std::size_t start, points;
        std::size_t first;  ///< the first of the three directions
    };

    std::size_t whole_elements(std::size_t points) const {
        return (points + code_.lanes - 1) / code_.lanes * code_.lanes;
    }

    /// The constants of the tape as elements of `parts` times the lanes.
    void prepare(const ClauseTape& tape, std::size_t parts) {
        tape_ = &tape;
        leaves_ = parts == 1 ? &value_leaves_ : &gradient_leaves_;
        const ClauseData& data = *tape.data;
        if (leaves_->data != tape.data) fill_leaves(tape.data, parts * code_.lanes);
        coordinates_ = static_cast<std::size_t>(data.coordinates);
        frame_.rows.leaves = leaves_->rows.data();
        frame_.rows.constants = static_cast<RowNumber>(data.constants.size());
        frame_.rows.first_value = data.first_value_row();
    }

    void fill_leaves(const std::shared_ptr<const ClauseData>& data, std::size_t element) {
        leaves_->data = data;
        const std::size_t constants = data->constants.size();
        Real* to = leaves_->constants.at_least(constants * element);
        leaves_->rows.assign(std::max<std::size_t>(data->first_value_row(), 1), to);
        for (std::size_t k = 0; k < constants; ++k, to += element) {
            std::fill_n(to, code_.lanes, static_cast<Real>(data->constants[k]));
            std::fill_n(to + code_.lanes, element - code_.lanes, Real(0));
            leaves_->rows[k] = to;
        }
    }

    /// Points of a batch: all, or as many as the cache has room for.
    std::size_t batch_points(const ClauseTape& tape, std::size_t count, std::size_t parts) const {
        const std::size_t rows = tape.rows - tape.data->constants.size();
        const std::size_t room = cache_bytes / (std::max<std::size_t>(rows, 1) * parts * sizeof(Real));
        const std::size_t fitting = std::clamp(room, least_points, most_points) / 16 * 16;
        return std::min(fitting, std::max(whole_elements(count), code_.lanes));
    }

    /// Value rows of `stride` numbers, and behind them as many rows for coordinates.
    void lay_out(const ClauseTape& tape, std::size_t stride) {
        const std::size_t values = tape.rows - frame_.rows.first_value;
        Real* const memory = memory_.at_least((values + coordinates_) * stride);
        frame_.rows.values = memory;
        frame_.rows.stride = stride;
        copies_ = memory + values * stride;
        frame_.clauses = tape.clauses.data();
        frame_.clause_count = tape.clauses.size();
    }

    const Real* row(RowNumber number) const {
        const batch::Rows<Real>& rows = frame_.rows;
        if (number < rows.first_value) return leaves_->rows[number];
        return rows.values + (number - rows.first_value) * rows.stride;
    }
    std::size_t mask_of(RowNumber number) const {
        return number < frame_.rows.constants ? 0 : ~std::size_t{0};
    }

    batch::OtherCall<Real> call_of(const Clause& clause, Real* out) {
        const auto operands = tape_->operands_of(clause);
        operands_.resize(operands.size());
        for (std::size_t k = 0; k < operands.size(); ++k)
            operands_[k] = {row(operands[k]), mask_of(operands[k])};
        return {clause.op, operands_, tape_->block_of(clause), frame_.numbers, code_.lanes, out};
    }

    void values_of(const ClauseTape& tape, std::span<const Real* const> coordinates, std::size_t start,
                   std::size_t points, Real* out) {
        const std::size_t numbers = whole_elements(points);
        frame_.numbers = numbers;
        for (std::size_t i = 0; i < coordinates_; ++i) {
            const Real*& leaf = leaves_->rows[frame_.rows.constants + i];
            leaf = coordinates[i] + start;
            if (numbers == points) continue;
            // points beyond the last one repeat it
            Real* const copy = copies_ + i * frame_.rows.stride;
            std::copy_n(leaf, points, copy);
            std::fill(copy + points, copy + numbers, leaf[points - 1]);
            leaf = copy;
        }
        const bool direct =
            numbers == points && !tape.clauses.empty() && tape.clauses.back().out == tape.root;
        frame_.last_out = direct ? out : nullptr;
        code_.values(frame_);
        if (direct) return;
        const Real* const from = row(tape.root);
        if (mask_of(tape.root)) {
            std::copy_n(from, points, out);
        } else {
            std::fill_n(out, points, from[0]);
        }
    }

    /// Derivatives along coordinates first .. first + 2.
    void gradients_of(const ClauseTape& tape, std::span<const Real* const> coordinates, const Pass& pass,
                      Real* values, std::span<Real* const> partials) {
        const std::size_t lanes = code_.lanes, element = 4 * lanes;
        const std::size_t elements = whole_elements(pass.points) / lanes;
        frame_.numbers = elements * element;
        frame_.last_out = nullptr;
        for (std::size_t i = 0; i < coordinates_; ++i) {
            Real* to = copies_ + i * frame_.rows.stride;
            leaves_->rows[frame_.rows.constants + i] = to;
            const Real* const from = coordinates[i] + pass.start;
            for (std::size_t p = 0; p < pass.points; p += lanes, to += element) {
                const std::size_t some = std::min(lanes, pass.points - p);
                std::copy_n(from + p, some, to);
                std::fill(to + some, to + lanes, from[pass.points - 1]);
                std::fill(to + lanes, to + element, Real(0));
                if (i >= pass.first && i < pass.first + 3)
                    std::fill_n(to + (1 + i - pass.first) * lanes, lanes, Real(1));
            }
        }
        code_.gradients(frame_);
        const Real* const from = row(tape.root);
        const std::size_t mask = mask_of(tape.root);
        for (std::size_t e = 0; e < elements; ++e) {
            const Real* const at = from + (e * element & mask);
            const std::size_t some = std::min(lanes, pass.points - e * lanes), to = pass.start + e * lanes;
            std::copy_n(at, some, values + to);
            for (std::size_t i = pass.first; i < partials.size() && i < pass.first + 3; ++i)
                std::copy_n(at + (1 + i - pass.first) * lanes, some, partials[i] + to);
        }
    }

    const batch::Code<Real> code_;
    batch::Frame<Real> frame_;
    const ClauseTape* tape_ = nullptr;  ///< the one that runs
    Leaves value_leaves_, gradient_leaves_;
    Leaves* leaves_ = nullptr;
    std::size_t coordinates_ = 0;
    Memory<Real> memory_;
    Real* copies_ = nullptr;  ///< rows for coordinates
    std::vector<batch::Operand<Real>> operands_;
    batch::OtherOperations<Real> other_;
};

template <class Real>
BatchVm<Real>::BatchVm() : machine_(std::make_unique<Machine>()) {}
template <class Real>
BatchVm<Real>::~BatchVm() = default;
template <class Real>
BatchVm<Real>::BatchVm(BatchVm&&) noexcept = default;
template <class Real>
BatchVm<Real>& BatchVm<Real>::operator=(BatchVm&&) noexcept = default;

template <class Real>
void BatchVm<Real>::values(const ClauseTape& tape, std::span<const Real* const> coordinates,
                           std::size_t count, Real* out) {
    machine_->values(tape, coordinates, count, out);
}

template <class Real>
void BatchVm<Real>::gradients(const ClauseTape& tape, std::span<const Real* const> coordinates,
                              std::size_t count, Real* values, std::span<Real* const> partials) {
    machine_->gradients(tape, coordinates, count, values, partials);
}

template class BatchVm<double>;
template class BatchVm<float>;

}  // namespace frep
