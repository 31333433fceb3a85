// What stands for a field in a part of space: its tape pruned for a box (prune.h), run in batches
// (batch_vm.h). Tested by tests/unit/eval/narrowed_field_test.cpp.
#pragma once

#include <memory>
#include <span>

#include "frep/eval/clause_tape.h"
#include "frep/eval/sampled_field.h"

namespace frep {

/// True where ranges cost much more than values do, so that looking at samples finds a surface sooner than
/// proofs do: sums over tens of skeletons, tables, several octaves of noise, whose ranges are found box by
/// box and term by term.
bool has_dear_ranges(const ClauseTape& tape);

class TapeCode;

/// Engines and workspace that a field and all its parts share: they serve one thread.
class Narrowing {
  public:
    explicit Narrowing(AxisMap map);
    ~Narrowing();
    Narrowing(const Narrowing&) = delete;
    Narrowing& operator=(const Narrowing&) = delete;

    /// As SampledField::narrow(), for the field that `tape` (in single assignment) computes in space. The
    /// parts keep what they need of `self` alive.
    static void narrow(const std::shared_ptr<Narrowing>& self, const ClauseTape& tape,
                       std::span<const Box3> boxes, std::span<SignRange> out,
                       std::span<std::shared_ptr<SampledField>> parts);

    /// As SampledField::narrow_signs(), for the field that `code` computes.
    static void narrow_signs(const std::shared_ptr<Narrowing>& self, const std::shared_ptr<TapeCode>& code,
                             std::span<const Box3> boxes, std::span<std::shared_ptr<SampledField>> near);

    /// As SampledField::values() and ranges(), for the field that a tape computes in space.
    void values(TapeCode& code, const PointSpans& points, std::span<double> out);
    void ranges(const ClauseTape& tape, std::span<const Box3> boxes, std::span<SignRange> out);

  private:
    friend class NarrowedField;
    friend class NearField;
    struct Engines;
    template <class IsOpen>
    void redo(TapeCode& code, const PointSpans& points, std::span<double> out, IsOpen is_open);
    void load_boxes(std::span<const Box3> boxes);

    std::unique_ptr<Engines> engines_;
};

}  // namespace frep
