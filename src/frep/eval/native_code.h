// NativeCode: a clause tape as machine code for this processor (x86-64 with AVX2 or AVX-512). The same bits
// as the interpreters of the same numeric profile, NaNs taken as equal. Method:
// docs/decisions/0013-native-code.md. Tested by tests/unit/eval/native_code_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "frep/eval/clause_tape.h"
#include "frep/eval/isa.h"
#include "frep/math/interval.h"

namespace frep {

struct NativeOptions {
    /// avx2 or avx512; one that the machine lacks gives no code.
    Isa isa = machine_isa();
    /// A range for each coordinate, within which nearly all points will lie: what cannot happen there (NaN,
    /// large arguments, a side of a minimum) costs nothing. Points outside get their right values, slowly.
    /// Empty: no assumption.
    std::span<const math::Interval> domain;
};

/// What was made.
struct NativeStatistics {
    std::size_t steps = 0;         ///< machine-like operations, dead ones included
    std::size_t instructions = 0;  ///< of all functions
    std::size_t code_bytes = 0;    ///< instructions
    std::size_t bytes = 0;         ///< with the constants behind them
    std::size_t workspace = 0;     ///< bytes that a run needs
};

/// Samples of a grid, x fastest. `x`, `y` and `z` are the coordinates of its columns, rows and layers (z one
/// number, any, for a plane); out has x.size() numbers a row, `row_stride` numbers from row to row and
/// `layer_stride` from layer to layer.
template <class Real>
struct NativeGrid {
    std::span<const Real> x, y, z;
    Real* out = nullptr;
    std::size_t row_stride = 0, layer_stride = 0;
};

/// Code for one tape and one type of numbers: double for the binary64 profile, float for binary32. May be run
/// by several threads at a time; they share nothing that changes.
template <class Real>
class NativeCode {
  public:
    /// True if this build and this machine can make native code.
    static bool is_available();
    /// Nothing where is_available() is false, or the system gives no executable memory.
    static std::optional<NativeCode> compile(const ClauseTape& tape, const NativeOptions& options = {});

    NativeCode(NativeCode&&) noexcept;
    NativeCode& operator=(NativeCode&&) noexcept;
    ~NativeCode();

    /// F at `count` points: coordinates[i][p] is coordinate i of point p. The arrays may have any alignment.
    void run(const Real* const* coordinates, std::size_t count, Real* out) const;
    /// F on a grid, for tapes of at most three coordinates. What depends on some of the axes only is computed
    /// once for these.
    void run(const NativeGrid<Real>& grid) const;

    const NativeStatistics& statistics() const;
    /// The machine code, for tests.
    std::span<const std::uint8_t> bytes() const;

  private:
    struct Program;
    explicit NativeCode(std::unique_ptr<Program> program);
    std::unique_ptr<Program> program_;
};

extern template class NativeCode<double>;
extern template class NativeCode<float>;

/// True if compiling for `points` points costs less than interpreting them (constants: native_code.cpp).
template <class Real>
bool native_code_pays(const ClauseTape& tape, std::size_t points);

}  // namespace frep
