// Batches for the vm; see vm_evaluator.h. The tapes are shared by clones, the machines belong to one thread.
// F without regions runs as clauses over wide batches (batch_vm.h); regions, attributes and intervals run on
// the register tape (vm.h), with the same bits.
#include "frep/eval/vm_evaluator.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "frep/eval/batch_vm.h"
#include "frep/eval/clause_tape.h"
#include "frep/eval/float_control.h"
#include "frep/eval/vm.h"

namespace frep {
namespace {

using math::Dual;
using math::Interval;
using math::Lanes;

constexpr std::size_t lanes = Lanes::size;

/// Memory that the registers of one engine may take.
constexpr std::size_t memory_limit = std::size_t{2} << 30;
/// Rows of a clause tape that take a small part of that.
constexpr std::size_t most_rows = std::size_t{1} << 18;

/// What clones share.
struct Program {
    Field field;
    Tape f;                             ///< F alone
    Tape all;                           ///< F and the attributes, when asked for
    std::optional<ClauseTape> clauses;  ///< F alone, where it has no region, in single assignment
    std::optional<ClauseTape> packed;   ///< the same over fewer rows, if they are few enough to be run
    bool attributes = false;
    std::int64_t max_steps = 0;
    const Tape& values() const { return attributes ? all : f; }
};

/// Elements first .. first + 3 of the points; points beyond `count` repeat the last one.
Lanes load_points(const double* from, std::size_t first, std::size_t count) {
    if (first + lanes <= count) return Lanes::load(from + first);
    Lanes value(from[count - 1]);
    for (std::size_t i = first; i < count; ++i) value.set(static_cast<int>(i - first), from[i]);
    return value;
}

void store_points(Lanes value, double* to, std::size_t first, std::size_t count) {
    if (first + lanes <= count) return value.store(to + first);
    for (std::size_t i = first; i < count; ++i) to[i] = value[static_cast<int>(i - first)];
}

class Vm final : public Evaluator {
  public:
    explicit Vm(std::shared_ptr<const Program> program) : program_(std::move(program)) {}

    std::unique_ptr<Evaluator> clone() const override { return std::make_unique<Vm>(program_); }
    int coordinates() const override { return program_->field.coordinates; }
    int outputs() const override { return static_cast<int>(program_->values().outputs.size()); }
    const ClauseTape* clauses() const override { return program_->clauses ? &*program_->clauses : nullptr; }

    void values(std::span<const double* const> coordinates, std::size_t count,
                std::span<double* const> out) override {
        const FloatControl control;
        const bool alone = out.size() == 1;
        if (alone && program_->packed) return batch_.values(*program_->packed, coordinates, count, out[0]);
        const Tape& tape = alone ? program_->f : program_->values();
        Machine<Lanes>& machine = ready(alone ? f_ : values_, tape);
        const std::size_t batch = machine.width() * lanes;
        for (std::size_t start = 0; start < count; start += batch) {
            const std::size_t points = std::min(batch, count - start);
            const std::size_t elements = (points + lanes - 1) / lanes;
            for (const std::uint32_t i : tape.inputs)
                for (std::size_t e = 0; e < elements; ++e)
                    machine.input(i)[e] = load_points(coordinates[i] + start, e * lanes, points);
            machine.run(elements);
            for (std::size_t k = 0; k < tape.outputs.size(); ++k) {
                const Row<Lanes> row = machine.output(k);
                for (std::size_t e = 0; e < elements; ++e)
                    store_points(row[e], out[k] + start, e * lanes, points);
            }
        }
    }

    void gradients(std::span<const double* const> coordinates, std::size_t count, double* values,
                   std::span<double* const> partials) override {
        const FloatControl control;
        const auto n = static_cast<std::size_t>(program_->field.coordinates);
        if (program_->packed)
            return batch_.gradients(*program_->packed, coordinates, count, values, partials.first(n));
        Machine<Dual<Lanes>>& machine = ready(duals_, program_->f);
        const std::size_t batch = machine.width() * lanes;
        for (std::size_t start = 0; start < count; start += batch)
            for (std::size_t first = 0; first == 0 || first < n; first += 3)
                gradient_pass(coordinates, {start, std::min(batch, count - start)}, first, values, partials);
    }

    void intervals(std::span<const Interval* const> coordinates, std::size_t count, Interval* out) override {
        const FloatControl control;
        const Tape& tape = program_->f;
        Machine<Interval>& machine = ready(boxes_, tape);
        for (std::size_t start = 0; start < count; start += machine.width()) {
            const std::size_t boxes = std::min(machine.width(), count - start);
            for (const std::uint32_t i : tape.inputs)
                std::copy_n(coordinates[i] + start, boxes, machine.input(i));
            machine.run(boxes);
            const Row<Interval> row = machine.output(0);
            for (std::size_t e = 0; e < boxes; ++e) out[start + e] = row[e];
        }
    }

  private:
    struct Batch {
        std::size_t start, points;
    };

    /// Derivatives along coordinates first .. first + 2.
    void gradient_pass(std::span<const double* const> coordinates, Batch batch, std::size_t first,
                       double* values, std::span<double* const> partials) {
        const std::size_t elements = (batch.points + lanes - 1) / lanes;
        for (const std::uint32_t i : program_->f.inputs) {
            Dual<Lanes>* row = duals_->input(i);
            const bool moves = i >= first && i < first + 3;
            for (std::size_t e = 0; e < elements; ++e) {
                const Lanes x = load_points(coordinates[i] + batch.start, e * lanes, batch.points);
                row[e] = moves ? Dual<Lanes>::variable(x, static_cast<int>(i - first)) : Dual<Lanes>(x);
            }
        }
        duals_->run(elements);
        const Row<Dual<Lanes>> f = duals_->output(0);
        const auto n = static_cast<std::size_t>(program_->field.coordinates);
        for (std::size_t e = 0; e < elements; ++e) {
            store_points(f[e].value, values + batch.start, e * lanes, batch.points);
            for (std::size_t i = first; i < n && i < first + 3; ++i)
                store_points(f[e].d[i - first], partials[i] + batch.start, e * lanes, batch.points);
        }
    }

    template <class T>
    Machine<T>& ready(std::unique_ptr<Machine<T>>& machine, const Tape& tape) {
        if (!machine) machine = std::make_unique<Machine<T>>(tape, program_->max_steps);
        return *machine;
    }

    std::shared_ptr<const Program> program_;
    BatchVm<double> batch_;
    std::unique_ptr<Machine<Lanes>> f_;       ///< F alone
    std::unique_ptr<Machine<Lanes>> values_;  ///< F and the attributes
    std::unique_ptr<Machine<Dual<Lanes>>> duals_;
    std::unique_ptr<Machine<Interval>> boxes_;
};

/// Bytes that a tape and its regions need in a machine of duals, the widest one.
std::size_t memory_needed(const Tape& tape) {
    std::size_t rows = tape.registers + tape.slots;
    for (const RegionCall& call : tape.regions)
        rows += call.code->region->cell_count + call.code->registers + call.code->outputs;
    return rows * sizeof(Dual<Lanes>);
}

}  // namespace

Result<std::unique_ptr<Evaluator>> make_vm(const Field& field, const EvaluatorOptions& options) {
    auto program = std::make_shared<Program>();
    program->field = field;
    program->attributes = options.attributes;
    program->max_steps = options.max_steps;
    TapeOptions tape_options;
    tape_options.registers = options.registers;
    auto f = make_tape(field, {&field.value, 1}, tape_options);
    if (!f) return f.error();
    program->f = std::move(*f);
    program->clauses = make_clause_tape(field);
    if (options.registers == 0 && program->clauses) {
        program->packed = program->clauses;
        pack_rows(*program->packed);
        if (program->packed->rows > most_rows) program->packed.reset();
    }
    if (options.attributes) {
        auto all = make_tape(field, field.roots(), tape_options);
        if (!all) return all.error();
        program->all = std::move(*all);
    }
    if (std::max(memory_needed(program->f), memory_needed(program->all)) > memory_limit)
        return Error{ErrorKind::over_limit,
                     "the model needs more memory for its values than an engine may take"};
    return std::unique_ptr<Evaluator>(std::make_unique<Vm>(std::move(program)));
}

}  // namespace frep
