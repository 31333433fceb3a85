// Memory, batches and the choice of the instruction set for batch_vm.h.
#include "frep/eval/batch_vm.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "frep/base/result.h"
#include "frep/eval/batch_frame.h"
#include "frep/eval/batch_other.h"
#include "frep/eval/float_control.h"

namespace frep {
namespace {

/// Bytes of the rows of a batch, which shall lie in the second cache, and the points of one. (A batch in the
/// first cache is worth less than fewer batches: a clause costs as much as some ten registers of points.)
constexpr std::size_t cache_bytes = 192 << 10;
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
        prepare(tape, coordinates.size(), values_);
        frame_.other = [](void* owner, const Clause& clause, Real* to) {
            Machine& machine = *static_cast<Machine*>(owner);
            machine.other_.values(machine.call_of(clause, to));
        };
        const std::size_t batch = batch_points(tape, count);
        lay_out(tape, batch);
        for (std::size_t start = 0; start < count; start += batch)
            values_of(tape, coordinates, start, std::min(batch, count - start), out + start);
    }

    void gradients(const ClauseTape& tape, std::span<const Real* const> coordinates, std::size_t count,
                   Real* values, std::span<Real* const> partials) {
        const FloatControl control;
        prepare(tape, coordinates.size(), gradients_);
        frame_.other = [](void* owner, const Clause& clause, Real* to) {
            Machine& machine = *static_cast<Machine*>(owner);
            machine.other_.gradients(machine.call_of(clause, to));
        };
        const std::size_t batch = batch_points(tape, count);
        lay_out(tape, batch);
        for (std::size_t start = 0; start < count; start += batch)
            for (std::size_t first = 0; first == 0 || first < partials.size(); first += 3)
                gradients_of(tape, coordinates, {start, std::min(batch, count - start), first}, values,
                             partials);
    }

  private:
    /// Where the rows begin, for values or for gradients; kept from call to call.
    struct Table {
        explicit Table(std::size_t numbers) : parts(numbers) {}

        std::size_t parts;  ///< numbers of an element for each lane: 1, or 4 for gradients
        std::shared_ptr<const ClauseData> data;  ///< whose constants stand in the first rows
        Memory<Real> constants, memory;
        std::vector<const Real*> rows;  ///< constants, coordinates, then as many values as have been needed
        const Real* begin = nullptr;    ///< of the memory when the value rows were laid out
        std::size_t stride = 0;         ///< numbers from one value row to the next
    };
    struct Pass {
        std::size_t start, points;
        std::size_t first;  ///< the first of the three directions
    };

    std::size_t whole_elements(std::size_t points) const {
        return (points + code_.lanes - 1) / code_.lanes * code_.lanes;
    }

    /// Makes the table ready for the constants of the tape.
    void prepare(const ClauseTape& tape, std::size_t coordinates, Table& table) {
        tape_ = &tape;
        table_ = &table;
        if (table.data != tape.data) fill_constants(table, tape.data);
        coordinates_ = std::min(coordinates, static_cast<std::size_t>(table.data->coordinates));
        frame_.constants = static_cast<RowNumber>(table.data->constants.size());
        frame_.clauses = tape.clauses.data();
        frame_.clause_count = tape.clauses.size();
    }

    void fill_constants(Table& table, const std::shared_ptr<const ClauseData>& data) {
        table.data = data;
        table.stride = 0;
        const std::size_t constants = data->constants.size(), element = table.parts * code_.lanes;
        Real* to = table.constants.at_least(constants * element);
        table.rows.assign(data->first_value_row(), nullptr);
        for (std::size_t k = 0; k < constants; ++k, to += element) {
            std::fill_n(to, code_.lanes, static_cast<Real>(data->constants[k]));
            std::fill_n(to + code_.lanes, element - code_.lanes, Real(0));
            table.rows[k] = to;
        }
    }

    /// Points of a batch: all, or as many as the cache has room for.
    std::size_t batch_points(const ClauseTape& tape, std::size_t count) const {
        const std::size_t rows = tape.rows - frame_.constants;
        const std::size_t room =
            cache_bytes / (std::max<std::size_t>(rows, 1) * table_->parts * sizeof(Real));
        const std::size_t fitting = std::clamp(room, least_points, most_points) / 16 * 16;
        return std::min(fitting, std::max(whole_elements(count), code_.lanes));
    }

    /// Rows for copies of the coordinates, then for values, `points` points each.
    void lay_out(const ClauseTape& tape, std::size_t points) {
        Table& table = *table_;
        const std::size_t stride = points * table.parts, first = table.data->first_value_row();
        const std::size_t values = tape.rows - first;
        copies_ = table.memory.at_least((coordinates_ + values) * stride);
        if (table.stride != stride || table.begin != copies_ || table.rows.size() < tape.rows) {
            table.stride = stride;
            table.begin = copies_;
            table.rows.resize(tape.rows);
            for (std::size_t k = 0; k < values; ++k)
                table.rows[first + k] = copies_ + (coordinates_ + k) * stride;
        }
        frame_.rows = table.rows.data();
    }

    const Real* row(RowNumber number) const { return table_->rows[number]; }
    std::size_t mask_of(RowNumber number) const { return number < frame_.constants ? 0 : ~std::size_t{0}; }

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
            if (!coordinates[i]) continue;
            const Real*& leaf = table_->rows[frame_.constants + i];
            leaf = coordinates[i] + start;
            if (numbers == points) continue;
            // points beyond the last one repeat it
            Real* const copy = copies_ + i * table_->stride;
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
        // copies of as many numbers as the compiler knows are moves, others are calls
        switch (code_.lanes) {
            case 4:
                return gradients_in<4>(tape, coordinates, pass, values, partials);
            case 8:
                return gradients_in<8>(tape, coordinates, pass, values, partials);
            default:
                FREP_CHECK(code_.lanes == 16);
                return gradients_in<16>(tape, coordinates, pass, values, partials);
        }
    }

    template <std::size_t lanes>
    void gradients_in(const ClauseTape& tape, std::span<const Real* const> coordinates, const Pass& pass,
                      Real* values, std::span<Real* const> partials) {
        constexpr std::size_t element = 4 * lanes;
        const std::size_t elements = whole_elements(pass.points) / lanes;
        frame_.numbers = elements * element;
        frame_.last_out = nullptr;
        const auto copy = [](const Real* from, std::size_t some, Real* to) {
            if (some == lanes) {
                std::memcpy(to, from, lanes * sizeof(Real));
            } else {
                std::copy_n(from, some, to);
            }
        };
        for (std::size_t i = 0; i < coordinates_; ++i) {
            if (!coordinates[i]) continue;
            Real* to = copies_ + i * table_->stride;
            table_->rows[frame_.constants + i] = to;
            const Real* const from = coordinates[i] + pass.start;
            for (std::size_t p = 0; p < pass.points; p += lanes, to += element) {
                const std::size_t some = std::min(lanes, pass.points - p);
                copy(from + p, some, to);
                std::fill(to + some, to + lanes, from[pass.points - 1]);
                for (std::size_t k = 0; k < 3; ++k)
                    std::fill_n(to + (1 + k) * lanes, lanes, i == pass.first + k ? Real(1) : Real(0));
            }
        }
        code_.gradients(frame_);
        const Real* const from = row(tape.root);
        const std::size_t mask = mask_of(tape.root);
        for (std::size_t e = 0; e < elements; ++e) {
            const Real* const at = from + (e * element & mask);
            const std::size_t some = std::min(lanes, pass.points - e * lanes), to = pass.start + e * lanes;
            copy(at, some, values + to);
            for (std::size_t i = pass.first; i < partials.size() && i < pass.first + 3; ++i)
                copy(at + (1 + i - pass.first) * lanes, some, partials[i] + to);
        }
    }

    const batch::Code<Real> code_;
    batch::Frame<Real> frame_;
    const ClauseTape* tape_ = nullptr;  ///< the one that runs
    Table values_{1}, gradients_{4};
    Table* table_ = nullptr;  ///< the one in use
    std::size_t coordinates_ = 0;
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
