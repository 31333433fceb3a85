// Writes native functions: a list of steps becomes a loop over vectors of points, with registers, spills,
// constants in memory and calls. Method: one forward pass; a value without a register is an operand in memory
// where the machine allows it; when registers run out, the one whose next use is furthest gives way (Belady
// 1966), and since values never change it is written to its slot at most once.
// Private to the native engine: the only header that includes asmjit. Tested by
// tests/unit/eval/native_code_test.cpp.
#pragma once

#include <asmjit/x86.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "frep/eval/isa.h"
#include "frep/eval/native_steps.h"

namespace frep::native {

/// Where a value lies in memory that the caller hands over: at `offset` bytes from a pointer, a vector or one
/// number for all lanes.
struct Source {
    ValueId value = no_value;
    bool scalar = false;
    std::uint32_t pointer = 0;
    std::int32_t offset = 0;
};
struct Target {
    ValueId value = no_value;
    std::uint32_t pointer = 0;
    std::int32_t offset = 0;
};
/// A point must lie in lo..hi (values that are constants), else the function stops before its vector.
struct DomainCheck {
    ValueId value = no_value, lo = no_value, hi = no_value;
};

/// A function to be written: computes the targets from the sources, vector by vector.
struct FunctionPlan {
    std::vector<Source> sources;  ///< all inputs, and values computed elsewhere
    std::vector<Target> targets;
    std::vector<std::int32_t> strides;  ///< by pointer: bytes from one vector to the next
    std::vector<DomainCheck> checks;
};

/// What native code is called with: void* pointers[], vectors, workspace; returns the vectors done.
using NativeFunction = std::size_t (*)(void* const* pointers, std::size_t vectors, void* workspace);
/// What native code calls. `mask`: lanes of `block` that count; block = r, x, y as vectors; r is changed.
using PatchHelper = void (*)(const void* function, unsigned mask, void* block);
/// block = the operands as vectors; the result replaces the first.
using CallHelper = void (*)(const void* context, void* block);

struct Helpers {
    PatchHelper patch1 = nullptr, patch2 = nullptr;
    CallHelper call = nullptr;
    std::vector<const void*> contexts;  ///< by number of the call
};

/// Code under construction: some functions and one pool of constants.
class CodeWriter : public asmjit::ErrorHandler {
  public:
    CodeWriter(const StepList& list, Isa isa, Helpers helpers);

    /// Appends a function; its number.
    std::size_t add(const FunctionPlan& plan);
    /// The bytes, position independent, and the offset of each function. False when a limit of the
    /// processor's encoding was hit.
    bool finish(std::vector<std::uint8_t>& bytes, std::vector<std::size_t>& offsets);
    /// Bytes of workspace that the functions need.
    std::size_t workspace() const { return workspace_; }
    /// Bytes of instructions; known after finish().
    std::size_t code_bytes() const { return code_bytes_; }
    /// Instructions so far.
    std::size_t instructions() const { return instructions_; }

    /// True for the instructions that may be written.
    static bool is_allowed(asmjit::InstId id);

    void handleError(asmjit::Error, const char*, asmjit::BaseEmitter*) override { failed_ = true; }

  private:
    friend class FunctionWriter;

    asmjit::x86::Mem constant_at(ValueId v);
    asmjit::x86::Mem broadcast_at(std::int32_t place) const;
    asmjit::x86::Mem ones();
    asmjit::x86::Mem one();
    void emit(asmjit::InstId id, const asmjit::Operand_& a = asmjit::Operand(),
              const asmjit::Operand_& b = asmjit::Operand(), const asmjit::Operand_& c = asmjit::Operand(),
              const asmjit::Operand_& d = asmjit::Operand());

    static constexpr std::int32_t near_constants = 128;

    const StepList& list_;
    bool wide_;  ///< AVX-512
    bool single_;
    Helpers helpers_;
    asmjit::CodeHolder code_;
    asmjit::x86::Assembler assembler_;
    asmjit::Label pool_;
    std::vector<std::uint64_t> constants_;          ///< bits, in the order of the pool
    std::vector<std::uint32_t> place_of_constant_;  ///< by value
    std::uint32_t place_of_ones_ = 0, place_of_one_ = 0;
    std::vector<asmjit::Label> functions_;
    std::size_t workspace_ = 0, instructions_ = 0, code_bytes_ = 0;
    bool failed_ = false;
};

/// One function of a CodeWriter.
class FunctionWriter {
  public:
    FunctionWriter(CodeWriter& code, const FunctionPlan& plan);
    void write();

  private:
    static constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();
    static constexpr std::int32_t no_slot = -1;
    static constexpr std::int8_t nowhere = -1;
    /// Workspace in bytes: r, x, y of a patch; all registers; operands of calls; then the slots.
    static constexpr std::size_t patch_area = 0, save_area = 3 * 64, mask_area = save_area + 32 * 64,
                                 call_area = mask_area + 64;
    static constexpr std::uint32_t pointer_registers = 10, safe_pointers = 3;
    enum Class : std::uint8_t { vectors, masks };

    struct Home {
        std::int32_t slot = no_slot;
        std::int8_t reg = nowhere;
        bool given = false;        ///< a source, or a constant: never written to a slot
        std::uint32_t source = 0;  ///< number of the source
        std::uint32_t next_use = never;
    };
    /// A patch, whose rare part is written behind the loop.
    struct Rare {
        asmjit::Label entry, back;
        Step step;
        std::uint32_t mask, out, x, y;
        std::uint32_t live_vectors, live_masks;
    };

    // native_writer.cpp: which values are needed and where they are
    void find_order();
    void find_uses();
    Class class_of(ValueId v) const;
    bool is_constant(ValueId v) const;
    std::uint32_t take(Class c);
    void evict(Class c, std::uint32_t reg);
    void hold(Class c, std::uint32_t reg, ValueId v);
    void release(ValueId v);
    void write_slot(ValueId v);
    std::uint32_t in_register(ValueId v);
    asmjit::Operand anywhere(ValueId v, std::uint32_t following);
    asmjit::x86::Mem memory_of(ValueId v);
    void after_operands(std::uint32_t index, const Step& step);
    std::uint32_t following(std::uint32_t index, int k) const {
        return following_[first_following_[index] + static_cast<std::uint32_t>(k)];
    }
    void spill_everything();
    std::uint32_t most_alive() const;
    void pin_constants();

    // native_emit.cpp: instructions
    void enter();
    void leave();
    void check_domain();
    void write_step(std::uint32_t index);
    void write_plain(std::uint32_t index, const Step& step);
    void write_compare(std::uint32_t index, const Step& step);
    void write_mask(std::uint32_t index, const Step& step);
    void write_choose(std::uint32_t index, const Step& step);
    void write_patch(std::uint32_t index, const Step& step);
    void write_call(std::uint32_t index, const Step& step);
    void write_rare(const Rare& rare);
    void store_targets();
    void advance();
    void point_at_constants();
    template <class Arguments>
    void call_outside(const void* function, Arguments arguments);
    std::size_t pointers_at_risk() const;
    void load(Class c, std::uint32_t reg, ValueId v);
    void move(Class c, const asmjit::Operand_& to, const asmjit::Operand_& from);
    asmjit::x86::Vec vector(std::uint32_t i) const;
    asmjit::x86::Mem work(std::size_t offset) const;
    asmjit::x86::Gp pointer(std::uint32_t i);
    static asmjit::x86::Gp pointer_register(std::uint32_t i);
    std::int32_t vector_bytes() const { return code_.wide_ ? 64 : 32; }

    CodeWriter& code_;
    const StepList& list_;
    const FunctionPlan& plan_;
    bool wide_, single_;
    std::vector<Home> homes_;
    std::vector<std::uint32_t> following_, first_following_;
    std::vector<ValueId> order_;  ///< the steps to write
    std::array<std::array<ValueId, 32>, 2> held_{};
    std::array<std::uint32_t, 2> free_{}, locked_{};
    std::uint32_t pinned_ = 0;   ///< vector registers that hold constants throughout
    std::uint32_t current_ = 0;  ///< place of the step under way
    std::vector<std::int32_t> free_slots_;
    std::vector<std::int32_t> leaving_slots_;  ///< free after the step under way, which may still read them
    std::int32_t slots_ = 0;
    std::vector<Rare> rare_;      ///< written behind the loop
    std::size_t call_area_ = 0;   ///< vectors
    std::size_t first_slot_ = 0;  ///< bytes into the workspace
    asmjit::Label loop_, end_;
};

}  // namespace frep::native
