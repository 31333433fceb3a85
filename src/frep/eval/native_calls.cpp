// Implementation of native_writer.h: rare lanes and clauses without instructions of their own, by calls of
// C++ functions. A rare part stands behind the loop and saves the registers; a call in the open has none to
// save.
#if defined(FREP_HAS_JIT)

#include "frep/base/result.h"
#include "frep/eval/native_writer.h"

namespace frep::native {

namespace x86 = asmjit::x86;
namespace Inst = x86::Inst;
using asmjit::imm;

/// Pointer registers that a call may change.
std::size_t FunctionWriter::pointers_at_risk() const {
    const std::size_t used = std::min<std::size_t>(plan_.strides.size(), pointer_registers);
    return used > safe_pointers ? used - safe_pointers : 0;
}

/// rdi, rsi and rdx are set by `arguments` once the pointers are safe. The stack is aligned at the loop.
template <class Arguments>
void FunctionWriter::call_outside(const void* function, Arguments arguments) {
    const std::size_t count = pointers_at_risk();
    for (std::size_t i = 0; i < count; ++i)
        code_.emit(Inst::kIdPush, pointer_register(static_cast<std::uint32_t>(safe_pointers + i)));
    if (count % 2 != 0) code_.emit(Inst::kIdPush, x86::rax);
    arguments();
    code_.emit(Inst::kIdVzeroupper);
    code_.emit(Inst::kIdMov, x86::rax, imm(reinterpret_cast<std::uintptr_t>(function)));
    code_.emit(Inst::kIdCall, x86::rax);
    if (count % 2 != 0) code_.emit(Inst::kIdPop, x86::rax);
    for (std::size_t i = count; i-- > 0;)
        code_.emit(Inst::kIdPop, pointer_register(static_cast<std::uint32_t>(safe_pointers + i)));
    point_at_constants();
}

void FunctionWriter::write_patch(std::uint32_t index, const Step& step) {
    Rare rare;
    rare.step = step;
    rare.mask = in_register(step.in[0]);
    const std::uint32_t r = in_register(step.in[1]);
    rare.x = in_register(step.in[2]);
    rare.y = step.count == 4 ? in_register(step.in[3]) : rare.x;
    rare.out = take(vectors);
    code_.emit(Inst::kIdVmovaps, vector(rare.out), vector(r));
    rare.entry = code_.assembler_.newLabel();
    rare.back = code_.assembler_.newLabel();
    if (wide_) {
        code_.emit(single_ ? Inst::kIdKortestw : Inst::kIdKortestb, x86::k(rare.mask), x86::k(rare.mask));
    } else {
        code_.emit(single_ ? Inst::kIdVmovmskps : Inst::kIdVmovmskpd, x86::eax, vector(rare.mask));
        code_.emit(Inst::kIdTest, x86::eax, x86::eax);
    }
    code_.emit(Inst::kIdJnz, rare.entry);
    code_.assembler_.bind(rare.back);
    after_operands(index, step);
    hold(vectors, rare.out, index);
    const auto occupied = [this](Class c) {
        std::uint32_t set = 0;
        for (std::uint32_t i = 0; i < 32; ++i)
            if (held_[c][i] != no_value) set |= 1u << i;
        return set;
    };
    rare.live_vectors = occupied(vectors) & ~(1u << rare.out);
    rare.live_masks = occupied(masks);
    rare_.push_back(rare);
}

void FunctionWriter::write_rare(const Rare& rare) {
    code_.assembler_.bind(rare.entry);
    move(vectors, work(patch_area), vector(rare.out));
    move(vectors, work(patch_area + 64), vector(rare.x));
    move(vectors, work(patch_area + 128), vector(rare.y));
    const auto each_live = [&](bool save) {
        for (std::uint32_t i = 0; i < 32; ++i) {
            const x86::Mem at = work(save_area + i * 64), mask_at = work(mask_area + i * 8);
            if ((rare.live_vectors >> i & 1) != 0)
                save ? move(vectors, at, vector(i)) : move(vectors, vector(i), at);
            if ((rare.live_masks >> i & 1) != 0)
                save ? move(masks, mask_at, x86::k(i)) : move(masks, x86::k(i), mask_at);
        }
    };
    each_live(true);
    const bool two = rare.step.count == 4;
    const PatchHelper helper = two ? code_.helpers_.patch2 : code_.helpers_.patch1;
    call_outside(reinterpret_cast<const void*>(helper), [&] {
        if (wide_) {
            code_.emit(Inst::kIdKmovw, x86::esi, x86::k(rare.mask));
        } else {
            code_.emit(single_ ? Inst::kIdVmovmskps : Inst::kIdVmovmskpd, x86::esi, vector(rare.mask));
        }
        code_.emit(Inst::kIdMov, x86::rdi, imm(rare.step.bits));
        code_.emit(Inst::kIdLea, x86::rdx, work(patch_area));
    });
    each_live(false);
    move(vectors, vector(rare.out), work(patch_area));
    code_.emit(Inst::kIdJmp, rare.back);
}

void FunctionWriter::write_call(std::uint32_t index, const Step& step) {
    const auto in = list_.operands_of(step);
    for (std::size_t k = 0; k < in.size(); ++k) {
        const std::uint32_t reg = in_register(in[k]);
        move(vectors, work(call_area + k * 64), vector(reg));
        locked_ = {};
    }
    after_operands(index, step);
    spill_everything();
    call_outside(reinterpret_cast<const void*>(code_.helpers_.call), [&] {
        code_.emit(Inst::kIdMov, x86::rdi,
                   imm(reinterpret_cast<std::uintptr_t>(code_.helpers_.contexts[step.bits])));
        code_.emit(Inst::kIdLea, x86::rsi, work(call_area));
    });
    const std::uint32_t out = take(vectors);
    move(vectors, vector(out), work(call_area));
    hold(vectors, out, index);
}

}  // namespace frep::native

#endif  // FREP_HAS_JIT
