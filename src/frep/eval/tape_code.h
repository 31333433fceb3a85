// TapeCode: a clause tape and all that runs it in binary64: its rows packed, and machine code once so many
// points have been asked for that compiling costs no more than it saves (native_code.h). Values are those of
// BatchVm, bit for bit, whichever runs. Tested by tests/unit/eval/tape_code_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "frep/eval/batch_vm.h"
#include "frep/eval/clause_tape.h"
#include "frep/eval/native_code.h"

namespace frep {

/// Serves one thread.
class TapeCode {
  public:
    /// `tape` is in single assignment.
    explicit TapeCode(ClauseTape tape) : tape_(std::move(tape)) {}

    const ClauseTape& tape() const { return tape_; }
    /// As BatchVm::values() and gradients(), which `vm` runs.
    void values(BatchVm<double>& vm, std::span<const double* const> coordinates, std::size_t count,
                double* out);
    void gradients(BatchVm<double>& vm, std::span<const double* const> coordinates, std::size_t count,
                   double* values, std::span<double* const> partials);
    bool is_native() const { return native_.has_value(); }

  private:
    const ClauseTape& packed();
    bool compiles_for(std::size_t points);

    ClauseTape tape_;
    std::optional<ClauseTape> packed_;
    std::optional<NativeCode<double>> native_;
    std::size_t points_ = 0;  ///< asked for so far, while that decides
    bool is_decided_ = false;
};

/// The code of tapes that parts of space share: equal short tapes get one object. Keeps the latest of them.
class TapeCodes {
  public:
    std::shared_ptr<TapeCode> code_for(const ClauseTape& tape);

  private:
    static constexpr std::size_t most_clauses = 256;  ///< longer tapes are rarely equal
    std::array<std::shared_ptr<TapeCode>, 64> kept_;  ///< by hash
};

}  // namespace frep
