// Implementation of native_code.h: compiling, and runs over columns of points.
#if defined(FREP_HAS_JIT)

#include "frep/eval/native_code.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <vector>

#include "frep/base/result.h"
#include "frep/eval/float_control.h"
#include "frep/eval/native_grid.h"

namespace frep {

using native::NativeFunction;

namespace {

constexpr std::size_t vector_bytes_of(Isa isa) { return isa == Isa::avx512 ? 64 : 32; }

/// Scratch memory of a run, aligned to the vectors. Small ones stand on the stack.
class Workspace {
  public:
    explicit Workspace(std::size_t bytes) {
        void* at = local_.data();
        std::size_t space = sizeof(local_);
        if (bytes + 64 > sizeof(local_)) {
            space = bytes + 64;
            heap_ = std::make_unique_for_overwrite<std::byte[]>(space);
            at = heap_.get();
        }
        aligned_ = std::align(64, bytes, at, space);
    }
    void* data() const { return aligned_; }

  private:
    std::array<std::byte, 16 << 10> local_;
    std::unique_ptr<std::byte[]> heap_;
    void* aligned_ = nullptr;
};

}  // namespace

template <class Real>
struct NativeCode<Real>::Program {
    ClauseTape tape;  ///< owns what the calls read; the code for points outside the domain is made of it
    Isa isa = Isa::sse2;
    std::size_t lanes = 0;
    std::vector<native::CallContext> calls;
    native::CodeMemory memory;
    NativeStatistics statistics;
    NativeFunction points = nullptr;
    std::vector<math::Interval> domain;  ///< empty: everywhere
    mutable std::once_flag whole_once;
    mutable std::unique_ptr<Program> whole;  ///< the code without a domain, when it was needed
    mutable std::once_flag grid_once;
    mutable std::unique_ptr<native::GridCode<Real>> grid;  ///< the code for grids, likewise

    bool build(const NativeOptions& options);
    native::Translation translated(bool& checked) const;
    const Program& without_domain() const;
    void run(const Real* const* coordinates, std::size_t count, Real* out) const;
    void run(const NativeGrid<Real>& samples) const;
    bool in_domain(const NativeGrid<Real>& samples) const;
    std::size_t run_vectors(const Real* const* coordinates, std::size_t first, std::size_t vectors, Real* out,
                            void* workspace) const;
};

namespace {

/// Steps that the root needs, constants aside.
std::size_t needed_steps(const native::Translation& made) {
    const auto& steps = made.list.steps();
    std::vector<bool> live(steps.size(), false);
    live[made.root] = true;
    std::size_t count = 0;
    for (std::size_t v = steps.size(); v-- > 0;) {
        if (!live[v] || steps[v].op == native::StepOp::constant) continue;
        ++count;
        for (const native::ValueId in : made.list.operands_of(steps[v])) live[in] = true;
    }
    return count;
}

/// Tapes of at most this many clauses are tried with and without their domain, whose check may cost more than
/// it saves.
constexpr std::size_t short_tape = 64;

}  // namespace

template <class Real>
native::Translation NativeCode<Real>::Program::translated(bool& checked) const {
    constexpr bool single = sizeof(Real) == 4;
    const bool wide = isa == Isa::avx512;
    native::Translation made = native::translate(tape, single, wide, domain);
    checked = !domain.empty();
    if (!checked || tape.clauses.size() > short_tape) return made;
    native::Translation plain = native::translate(tape, single, wide, {});
    if (needed_steps(plain) > needed_steps(made) + 2 * domain.size() + 2) return made;
    checked = false;
    return plain;
}

template <class Real>
bool NativeCode<Real>::Program::build(const NativeOptions& options) {
    isa = options.isa;
    lanes = vector_bytes_of(isa) / sizeof(Real);
    domain.assign(options.domain.begin(), options.domain.end());
    bool checked = false;
    native::Translation made = translated(checked);
    calls = std::move(made.calls);
    native::StepList& list = made.list;
    native::FunctionPlan plan;
    const auto bytes = static_cast<std::int32_t>(vector_bytes_of(isa));
    for (std::size_t i = 0; i < made.coordinates.size(); ++i) {
        plan.sources.push_back({made.coordinates[i], false, static_cast<std::uint32_t>(i), 0});
        plan.strides.push_back(bytes);
        if (!checked) continue;
        const math::Interval& range = domain[i];
        plan.checks.push_back({made.coordinates[i], list.constant(range.lo), list.constant(range.hi)});
    }
    plan.targets.push_back({made.root, static_cast<std::uint32_t>(plan.strides.size()), 0});
    plan.strides.push_back(bytes);
    native::CodeWriter writer(list, isa, native::helpers_for<Real>(calls));
    writer.add(plan);
    std::vector<std::uint8_t> code;
    std::vector<std::size_t> offsets;
    if (!writer.finish(code, offsets)) return false;
    memory = native::CodeMemory(code);
    if (!memory.data()) return false;
    points = reinterpret_cast<NativeFunction>(reinterpret_cast<std::uintptr_t>(memory.data() + offsets[0]));
    statistics = {list.steps().size(), writer.instructions(), writer.code_bytes(), code.size(),
                  writer.workspace()};
    return true;
}

template <class Real>
const typename NativeCode<Real>::Program& NativeCode<Real>::Program::without_domain() const {
    std::call_once(whole_once, [this] {
        auto made = std::make_unique<Program>();
        made->tape = tape;
        FREP_CHECK(made->build({isa, {}}));
        whole = std::move(made);
    });
    return *whole;
}

/// Whole vectors from point `first` on; stops before one that has a point outside the domain.
template <class Real>
std::size_t NativeCode<Real>::Program::run_vectors(const Real* const* coordinates, std::size_t first,
                                                   std::size_t vectors, Real* out, void* workspace) const {
    const auto count = static_cast<std::size_t>(tape.data->coordinates);
    std::array<void*, 16> few;
    std::vector<void*> many;
    if (count + 1 > few.size()) many.resize(count + 1);
    void** const pointers = many.empty() ? few.data() : many.data();
    for (std::size_t i = 0; i < count; ++i) pointers[i] = const_cast<Real*>(coordinates[i] + first);
    pointers[count] = out + first;
    return points(pointers, vectors, workspace);
}

template <class Real>
void NativeCode<Real>::Program::run(const Real* const* coordinates, std::size_t count, Real* out) const {
    const Workspace workspace(statistics.workspace);
    const std::size_t vectors = count / lanes;
    for (std::size_t done = 0; done < vectors;) {
        done += run_vectors(coordinates, done * lanes, vectors - done, out, workspace.data());
        if (done == vectors) break;
        std::vector<const Real*> shifted(coordinates, coordinates + tape.data->coordinates);
        for (const Real*& at : shifted) at += done * lanes;
        without_domain().run(shifted.data(), lanes, out + done * lanes);
        ++done;
    }
    const std::size_t rest = count - vectors * lanes;
    if (rest == 0) return;
    // The last points, repeated to a whole vector.
    const auto columns = static_cast<std::size_t>(tape.data->coordinates);
    std::vector<Real> padded((columns + 1) * lanes);
    std::vector<const Real*> at(columns);
    for (std::size_t i = 0; i < columns; ++i) {
        for (std::size_t p = 0; p < lanes; ++p)
            padded[i * lanes + p] = coordinates[i][std::min(vectors * lanes + p, count - 1)];
        at[i] = padded.data() + i * lanes;
    }
    Real* const values = padded.data() + columns * lanes;
    if (run_vectors(at.data(), 0, 1, values, workspace.data()) == 0)
        without_domain().run(at.data(), lanes, values);
    std::copy_n(values, rest, out + vectors * lanes);
}

template <class Real>
bool NativeCode<Real>::Program::in_domain(const NativeGrid<Real>& samples) const {
    const std::array<std::span<const Real>, 3> axes = {samples.x, samples.y, samples.z};
    for (std::size_t i = 0; i < domain.size(); ++i) {
        const auto lo = static_cast<Real>(domain[i].lo), hi = static_cast<Real>(domain[i].hi);
        for (const Real x : axes[i])
            if (!(x >= lo && x <= hi)) return false;
    }
    return true;
}

template <class Real>
void NativeCode<Real>::Program::run(const NativeGrid<Real>& samples) const {
    if (!in_domain(samples)) return without_domain().run(samples);
    std::call_once(grid_once, [this] {
        auto made = std::make_unique<native::GridCode<Real>>();
        FREP_CHECK(made->build(tape, isa, domain));
        grid = std::move(made);
    });
    grid->run(samples);
}

template <class Real>
NativeCode<Real>::NativeCode(std::unique_ptr<Program> program) : program_(std::move(program)) {}
template <class Real>
NativeCode<Real>::NativeCode(NativeCode&&) noexcept = default;
template <class Real>
NativeCode<Real>& NativeCode<Real>::operator=(NativeCode&&) noexcept = default;
template <class Real>
NativeCode<Real>::~NativeCode() = default;

template <class Real>
bool NativeCode<Real>::is_available() {
    return machine_isa() >= Isa::avx2;
}

template <class Real>
std::optional<NativeCode<Real>> NativeCode<Real>::compile(const ClauseTape& tape,
                                                          const NativeOptions& options) {
    if (options.isa < Isa::avx2 || options.isa > machine_isa()) return std::nullopt;
    auto program = std::make_unique<Program>();
    program->tape = tape;
    if (!program->build(options)) return std::nullopt;
    return NativeCode(std::move(program));
}

template <class Real>
void NativeCode<Real>::run(const Real* const* coordinates, std::size_t count, Real* out) const {
    const FloatControl control;
    program_->run(coordinates, count, out);
}

template <class Real>
void NativeCode<Real>::run(const NativeGrid<Real>& grid) const {
    const FloatControl control;
    program_->run(grid);
}

template <class Real>
const NativeStatistics& NativeCode<Real>::statistics() const {
    return program_->statistics;
}

template <class Real>
std::span<const std::uint8_t> NativeCode<Real>::bytes() const {
    return {program_->memory.data(), program_->statistics.bytes};
}

/// Nanoseconds, measured by bench/jit_bench.cpp (Zen 5, AVX-512): compiling a tape, and an operation of cost
/// 1 of it; what native code saves against BatchVm for such an operation at a point.
template <class Real>
bool native_code_pays(const ClauseTape& tape, std::size_t points) {
    constexpr double tape_cost = 5000, operation_cost = 250;
    constexpr double saved = sizeof(Real) == 4 ? 0.035 : 0.065;
    if (!NativeCode<Real>::is_available()) return false;
    const double operations = cost_of(tape);
    return static_cast<double>(points) * saved * operations > tape_cost + operation_cost * operations;
}

template class NativeCode<double>;
template class NativeCode<float>;
template bool native_code_pays<double>(const ClauseTape&, std::size_t);
template bool native_code_pays<float>(const ClauseTape&, std::size_t);

}  // namespace frep

#endif  // FREP_HAS_JIT
