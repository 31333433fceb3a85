// Implementation of native_writer.h: the instructions. Registers of a function: rbx pointers[], rbp
// workspace, r12 vectors left, rax scratch, the others pointers as far as they reach.
#if defined(FREP_HAS_JIT)

#include <algorithm>

#include "frep/base/result.h"
#include "frep/eval/native_writer.h"

namespace frep::native {

namespace x86 = asmjit::x86;
namespace Inst = x86::Inst;
using asmjit::imm;
using asmjit::InstId;

namespace {

/// Every instruction that may be written. Nothing here enters the system, touches other memory than its
/// operands or changes the floating-point state.
constexpr InstId allowed[] = {
    Inst::kIdMov,          Inst::kIdPush,      Inst::kIdPop,         Inst::kIdAdd,
    Inst::kIdSub,          Inst::kIdCmp,       Inst::kIdTest,        Inst::kIdLea,
    Inst::kIdDec,          Inst::kIdJz,        Inst::kIdJnz,         Inst::kIdJnc,
    Inst::kIdJmp,          Inst::kIdCall,      Inst::kIdRet,         Inst::kIdVzeroupper,
    Inst::kIdVaddps,       Inst::kIdVaddpd,    Inst::kIdVsubps,      Inst::kIdVsubpd,
    Inst::kIdVmulps,       Inst::kIdVmulpd,    Inst::kIdVdivps,      Inst::kIdVdivpd,
    Inst::kIdVsqrtps,      Inst::kIdVsqrtpd,   Inst::kIdVminps,      Inst::kIdVminpd,
    Inst::kIdVscalefps,    Inst::kIdVscalefpd, Inst::kIdVmaxps,      Inst::kIdVmaxpd,
    Inst::kIdVroundps,     Inst::kIdVroundpd,  Inst::kIdVrndscaleps, Inst::kIdVrndscalepd,
    Inst::kIdVandps,       Inst::kIdVandpd,    Inst::kIdVorps,       Inst::kIdVorpd,
    Inst::kIdVxorps,       Inst::kIdVxorpd,    Inst::kIdVpaddd,      Inst::kIdVpaddq,
    Inst::kIdVpsubd,       Inst::kIdVpsubq,    Inst::kIdVpslld,      Inst::kIdVpsllq,
    Inst::kIdVpsrld,       Inst::kIdVpsrlq,    Inst::kIdVcmpps,      Inst::kIdVcmppd,
    Inst::kIdVptestmd,     Inst::kIdVptestmq,  Inst::kIdKandw,       Inst::kIdKandb,
    Inst::kIdKorw,         Inst::kIdKorb,      Inst::kIdKnotw,       Inst::kIdKnotb,
    Inst::kIdKxorw,        Inst::kIdKxorb,     Inst::kIdKxnorw,      Inst::kIdKxnorb,
    Inst::kIdKortestw,     Inst::kIdKortestb,  Inst::kIdKmovw,       Inst::kIdVmovmskps,
    Inst::kIdVmovmskpd,    Inst::kIdVblendmps, Inst::kIdVblendmpd,   Inst::kIdVblendvps,
    Inst::kIdVblendvpd,    Inst::kIdVmovups,   Inst::kIdVmovaps,     Inst::kIdVbroadcastss,
    Inst::kIdVbroadcastsd,
};

struct Both {
    InstId single, twice;
};
Both instructions_of(StepOp op) {
    switch (op) {
        case StepOp::add:
            return {Inst::kIdVaddps, Inst::kIdVaddpd};
        case StepOp::subtract:
            return {Inst::kIdVsubps, Inst::kIdVsubpd};
        case StepOp::multiply:
            return {Inst::kIdVmulps, Inst::kIdVmulpd};
        case StepOp::divide:
            return {Inst::kIdVdivps, Inst::kIdVdivpd};
        case StepOp::square_root:
            return {Inst::kIdVsqrtps, Inst::kIdVsqrtpd};
        case StepOp::lesser:
            return {Inst::kIdVminps, Inst::kIdVminpd};
        case StepOp::greater:
            return {Inst::kIdVmaxps, Inst::kIdVmaxpd};
        case StepOp::bit_and:
            return {Inst::kIdVandps, Inst::kIdVandpd};
        case StepOp::bit_or:
            return {Inst::kIdVorps, Inst::kIdVorpd};
        case StepOp::bit_xor:
            return {Inst::kIdVxorps, Inst::kIdVxorpd};
        case StepOp::word_add:
            return {Inst::kIdVpaddd, Inst::kIdVpaddq};
        case StepOp::word_subtract:
            return {Inst::kIdVpsubd, Inst::kIdVpsubq};
        case StepOp::shift_left:
            return {Inst::kIdVpslld, Inst::kIdVpsllq};
        case StepOp::shift_right:
            return {Inst::kIdVpsrld, Inst::kIdVpsrlq};
        case StepOp::scale:
            return {Inst::kIdVscalefps, Inst::kIdVscalefpd};
        default:
            FREP_CHECK(false);
    }
}

/// The predicate for the operands in the other order.
std::uint8_t turned(std::uint8_t predicate) {
    switch (static_cast<Predicate>(predicate)) {
        case Predicate::less:
            return static_cast<std::uint8_t>(Predicate::greater);
        case Predicate::less_equal:
            return static_cast<std::uint8_t>(Predicate::greater_equal);
        case Predicate::not_less:
            return static_cast<std::uint8_t>(Predicate::not_greater);
        case Predicate::not_less_equal:
            return static_cast<std::uint8_t>(Predicate::not_greater_equal);
        default:
            return predicate;
    }
}

}  // namespace

CodeWriter::CodeWriter(const StepList& list, Isa isa, Helpers helpers)
    : list_(list), wide_(isa == Isa::avx512), single_(list.single()), helpers_(std::move(helpers)) {
    code_.init(asmjit::Environment::host());
    code_.setErrorHandler(this);
    code_.attach(&assembler_);
    pool_ = assembler_.newLabel();
    place_of_constant_.resize(list.steps().size(), 0);
}

void CodeWriter::emit(InstId id, const asmjit::Operand_& a, const asmjit::Operand_& b,
                      const asmjit::Operand_& c, const asmjit::Operand_& d) {
    ++instructions_;
    FREP_CHECK(is_allowed(id));
    assembler_.emit(id, a, b, c, d);
}

bool CodeWriter::is_allowed(InstId id) {
    static const auto table = [] {
        std::array<bool, Inst::_kIdCount> ids{};
        for (const InstId one : allowed) ids[one] = true;
        return ids;
    }();
    return id < table.size() && table[id];
}

x86::Mem CodeWriter::constant_at(ValueId v) {
    if (place_of_constant_[v] == 0) {
        constants_.push_back(list_.steps()[v].bits);
        place_of_constant_[v] = static_cast<std::uint32_t>(constants_.size());
    }
    const auto place = static_cast<std::int32_t>(place_of_constant_[v] - 1);
    return wide_ ? broadcast_at(place) : x86::ptr(pool_, place * 32);
}

/// Near constants are reached from r11 by a displacement of one byte, which counts in items: shorter code,
/// and long tapes are bound by the bytes of their code.
x86::Mem CodeWriter::broadcast_at(std::int32_t place) const {
    const std::int32_t item = single_ ? 4 : 8;
    const x86::Mem at = place < 2 * near_constants ? x86::ptr(x86::r11, (place - near_constants) * item)
                                                   : x86::ptr(pool_, place * item);
    return single_ ? at._1to16() : at._1to8();
}

void FunctionWriter::point_at_constants() {
    if (!wide_) return;
    const std::int32_t item = single_ ? 4 : 8;
    code_.emit(Inst::kIdLea, x86::r11, x86::ptr(code_.pool_, CodeWriter::near_constants * item));
}

x86::Mem CodeWriter::ones() {
    if (place_of_ones_ == 0) {
        constants_.push_back(~std::uint64_t{0});
        place_of_ones_ = static_cast<std::uint32_t>(constants_.size());
    }
    return x86::ptr(pool_, static_cast<std::int32_t>(place_of_ones_ - 1) * 32);
}

x86::Mem CodeWriter::one() {
    if (place_of_one_ == 0) {
        constants_.push_back(1);
        place_of_one_ = static_cast<std::uint32_t>(constants_.size());
    }
    return broadcast_at(static_cast<std::int32_t>(place_of_one_ - 1));
}

std::size_t CodeWriter::add(const FunctionPlan& plan) {
    assembler_.align(asmjit::AlignMode::kCode, 64);
    functions_.push_back(assembler_.newLabel());
    assembler_.bind(functions_.back());
    FunctionWriter(*this, plan).write();
    return functions_.size() - 1;
}

bool CodeWriter::finish(std::vector<std::uint8_t>& bytes, std::vector<std::size_t>& offsets) {
    code_bytes_ = assembler_.offset();
    assembler_.align(asmjit::AlignMode::kData, 64);
    assembler_.bind(pool_);
    const int copies = wide_ ? 1 : single_ ? 8 : 4;
    for (const std::uint64_t bits : constants_)
        for (int i = 0; i < copies; ++i) assembler_.embed(&bits, single_ ? 4 : 8);
    if (failed_ || code_.flatten() != asmjit::kErrorOk || code_.resolveUnresolvedLinks() != asmjit::kErrorOk)
        return false;
    bytes.resize(code_.codeSize());
    if (code_.copyFlattenedData(bytes.data(), bytes.size()) != asmjit::kErrorOk) return false;
    offsets.clear();
    for (const asmjit::Label& label : functions_)
        offsets.push_back(static_cast<std::size_t>(code_.labelOffset(label)));
    return !failed_;
}

x86::Vec FunctionWriter::vector(std::uint32_t i) const {
    return wide_ ? x86::Vec(x86::zmm(i)) : x86::Vec(x86::ymm(i));
}
x86::Mem FunctionWriter::work(std::size_t offset) const {
    return x86::ptr(x86::rbp, static_cast<std::int32_t>(offset));
}

/// The first safe_pointers of them survive calls.
x86::Gp FunctionWriter::pointer_register(std::uint32_t i) {
    const std::array<x86::Gp, pointer_registers> all = {x86::r13, x86::r14, x86::r15, x86::rsi, x86::rdi,
                                                        x86::rcx, x86::rdx, x86::r8,  x86::r9,  x86::r10};
    return all[i];
}

/// The register that holds pointer i, or rax with it loaded.
x86::Gp FunctionWriter::pointer(std::uint32_t i) {
    if (i < pointer_registers) return pointer_register(i);
    code_.emit(Inst::kIdMov, x86::rax, x86::ptr(x86::rbx, static_cast<std::int32_t>(i * 8)));
    return x86::rax;
}

void FunctionWriter::move(Class c, const asmjit::Operand_& to, const asmjit::Operand_& from) {
    code_.emit(c == masks ? Inst::kIdKmovw : Inst::kIdVmovups, to, from);
}

void FunctionWriter::load(Class c, std::uint32_t reg, ValueId v) {
    if (c == masks) return move(c, x86::k(reg), memory_of(v));
    const Home& home = homes_[v];
    const bool source = home.given && !is_constant(v);
    x86::Mem from = memory_of(v);
    if ((is_constant(v) && wide_) || (source && plan_.sources[home.source].scalar)) {
        from.resetBroadcast();
        code_.emit(single_ ? Inst::kIdVbroadcastss : Inst::kIdVbroadcastsd, vector(reg), from);
    } else {
        move(c, vector(reg), from);
    }
}

void FunctionWriter::enter() {
    first_slot_ = call_area + call_area_ * 64;
    for (const x86::Gp& reg : {x86::rbx, x86::rbp, x86::r12, x86::r13, x86::r14, x86::r15, x86::rsi})
        code_.emit(Inst::kIdPush, reg);
    code_.emit(Inst::kIdMov, x86::rbx, x86::rdi);
    code_.emit(Inst::kIdMov, x86::rbp, x86::rdx);
    code_.emit(Inst::kIdMov, x86::r12, x86::rsi);
    const auto count = std::min<std::size_t>(plan_.strides.size(), pointer_registers);
    for (std::uint32_t i = 0; i < count; ++i)
        code_.emit(Inst::kIdMov, pointer_register(i), x86::ptr(x86::rbx, static_cast<std::int32_t>(i * 8)));
    end_ = code_.assembler_.newLabel();
    loop_ = code_.assembler_.newLabel();
    code_.emit(Inst::kIdTest, x86::r12, x86::r12);
    code_.emit(Inst::kIdJz, end_);
    point_at_constants();
    pin_constants();
    code_.assembler_.align(asmjit::AlignMode::kCode, 32);
    code_.assembler_.bind(loop_);
}

/// Pointers to the next vector, and round again.
void FunctionWriter::advance() {
    for (std::uint32_t i = 0; i < plan_.strides.size(); ++i) {
        if (plan_.strides[i] == 0) continue;
        if (i < pointer_registers) {
            code_.emit(Inst::kIdAdd, pointer_register(i), imm(plan_.strides[i]));
        } else {
            code_.emit(Inst::kIdAdd, x86::qword_ptr(x86::rbx, static_cast<std::int32_t>(i * 8)),
                       imm(plan_.strides[i]));
        }
    }
    code_.emit(Inst::kIdDec, x86::r12);
    code_.emit(Inst::kIdJnz, loop_);
}

void FunctionWriter::leave() {
    code_.assembler_.bind(end_);
    code_.emit(Inst::kIdPop, x86::rax);
    code_.emit(Inst::kIdSub, x86::rax, x86::r12);
    for (const x86::Gp& reg : {x86::r15, x86::r14, x86::r13, x86::r12, x86::rbp, x86::rbx})
        code_.emit(Inst::kIdPop, reg);
    code_.emit(Inst::kIdVzeroupper);
    code_.emit(Inst::kIdRet);
    for (const Rare& rare : rare_) write_rare(rare);
    code_.workspace_ = std::max(code_.workspace_, first_slot_ + static_cast<std::size_t>(slots_) * 64);
}

void FunctionWriter::check_domain() {
    constexpr int at_least = 0x1d, at_most = 0x12;
    const InstId compare = single_ ? Inst::kIdVcmpps : Inst::kIdVcmppd;
    bool first = true;
    const std::uint32_t scratch = wide_ ? 0u : 3u << 14;
    free_[vectors] &= ~scratch;
    for (const DomainCheck& check : plan_.checks) {
        const x86::Vec x = vector(in_register(check.value));
        for (const bool low : {true, false}) {
            const x86::Mem bound = code_.constant_at(low ? check.lo : check.hi);
            if (wide_) {
                if (!first) code_.assembler_.k(x86::k1);
                code_.emit(compare, x86::k1, x, bound, imm(low ? at_least : at_most));
            } else {
                const x86::Vec to = vector(first ? 15 : 14);
                code_.emit(compare, to, x, bound, imm(low ? at_least : at_most));
                if (!first) code_.emit(Inst::kIdVandps, vector(15), vector(15), to);
            }
            first = false;
        }
        locked_ = {};
        if (homes_[check.value].next_use == never) release(check.value);
    }
    free_[vectors] |= scratch;
    if (first) return;
    if (wide_) {
        code_.emit(single_ ? Inst::kIdKortestw : Inst::kIdKortestb, x86::k1, x86::k1);
        code_.emit(Inst::kIdJnc, end_);
    } else {
        code_.emit(single_ ? Inst::kIdVmovmskps : Inst::kIdVmovmskpd, x86::eax, vector(15));
        code_.emit(Inst::kIdCmp, x86::eax, imm(single_ ? 0xff : 0xf));
        code_.emit(Inst::kIdJnz, end_);
    }
}

void FunctionWriter::store_targets() {
    for (const Target& target : plan_.targets) {
        const std::uint32_t reg = in_register(target.value);
        code_.emit(Inst::kIdVmovups, x86::ptr(pointer(target.pointer), target.offset), vector(reg));
        locked_ = {};
    }
}

void FunctionWriter::write_step(std::uint32_t index) {
    const Step& step = list_.steps()[index];
    switch (step.op) {
        case StepOp::compare:
        case StepOp::low_bit:
            return write_compare(index, step);
        case StepOp::mask_and:
        case StepOp::mask_or:
        case StepOp::mask_not:
        case StepOp::mask_constant:
            return write_mask(index, step);
        case StepOp::choose:
            return write_choose(index, step);
        case StepOp::patch:
            return write_patch(index, step);
        case StepOp::call:
            return write_call(index, step);
        default:
            return write_plain(index, step);
    }
}

void FunctionWriter::write_plain(std::uint32_t index, const Step& step) {
    if (step.op == StepOp::square_root || step.op == StepOp::round) {
        const asmjit::Operand a = anywhere(step.in[0], following(index, 0));
        after_operands(index, step);
        const std::uint32_t out = take(vectors);
        if (step.op == StepOp::square_root) {
            code_.emit(single_ ? Inst::kIdVsqrtps : Inst::kIdVsqrtpd, vector(out), a);
        } else {
            const InstId id = wide_ ? (single_ ? Inst::kIdVrndscaleps : Inst::kIdVrndscalepd)
                                    : (single_ ? Inst::kIdVroundps : Inst::kIdVroundpd);
            code_.emit(id, vector(out), a, imm(8 | step.immediate));
        }
        return hold(vectors, out, index);
    }
    const Both ids = instructions_of(step.op);
    const InstId id = single_ ? ids.single : ids.twice;
    // A commuting operation reads memory through either operand.
    const bool swap = step.count == 2 && step.op != StepOp::subtract && step.op != StepOp::divide &&
                      step.op != StepOp::lesser && step.op != StepOp::greater &&
                      step.op != StepOp::word_subtract && step.op != StepOp::scale &&
                      homes_[step.in[0]].reg == nowhere && homes_[step.in[1]].reg != nowhere;
    const int one = swap ? 1 : 0;
    const x86::Vec a = vector(in_register(step.in[one]));
    const asmjit::Operand b = step.count == 2 ? anywhere(step.in[1 - one], following(index, 1 - one))
                                              : static_cast<asmjit::Operand>(imm(step.immediate));
    after_operands(index, step);
    const std::uint32_t out = take(vectors);
    code_.emit(id, vector(out), a, b);
    hold(vectors, out, index);
}

void FunctionWriter::write_compare(std::uint32_t index, const Step& step) {
    // A constant goes second: it can stay in memory.
    const bool turn = step.op == StepOp::compare && is_constant(step.in[0]) && !is_constant(step.in[1]);
    const int one = turn ? 1 : 0;
    const x86::Vec a = vector(in_register(step.in[one]));
    if (step.op == StepOp::low_bit) {
        after_operands(index, step);
        if (wide_) {
            const std::uint32_t out = take(masks);
            // Shifting the lowest bit out and in again would take a register; testing it takes a constant.
            code_.emit(single_ ? Inst::kIdVptestmd : Inst::kIdVptestmq, x86::k(out), a, code_.one());
            return hold(masks, out, index);
        }
        const std::uint32_t out = take(vectors);
        code_.emit(single_ ? Inst::kIdVpslld : Inst::kIdVpsllq, vector(out), a, imm(single_ ? 31 : 63));
        return hold(vectors, out, index);
    }
    const asmjit::Operand b = step.in[0] == step.in[1]
                                  ? static_cast<asmjit::Operand>(a)
                                  : anywhere(step.in[1 - one], following(index, 1 - one));
    after_operands(index, step);
    const Class c = wide_ ? masks : vectors;
    const std::uint32_t out = take(c);
    const asmjit::Operand to =
        wide_ ? static_cast<asmjit::Operand>(x86::k(out)) : static_cast<asmjit::Operand>(vector(out));
    code_.emit(single_ ? Inst::kIdVcmpps : Inst::kIdVcmppd, to, a, b,
               imm(turn ? turned(step.immediate) : step.immediate));
    hold(c, out, index);
}

void FunctionWriter::write_mask(std::uint32_t index, const Step& step) {
    const Class c = wide_ ? masks : vectors;
    std::array<std::uint32_t, 2> in{};
    for (std::size_t k = 0; k < step.count; ++k) in[k] = in_register(step.in[k]);
    after_operands(index, step);
    const std::uint32_t out = take(c);
    const bool conjunction = step.op == StepOp::mask_and;
    if (wide_) {
        const auto pick = [this](InstId w, InstId b) { return single_ ? w : b; };
        if (step.op == StepOp::mask_not) {
            code_.emit(pick(Inst::kIdKnotw, Inst::kIdKnotb), x86::k(out), x86::k(in[0]));
        } else if (step.op == StepOp::mask_constant) {
            code_.emit(step.immediate != 0 ? pick(Inst::kIdKxnorw, Inst::kIdKxnorb)
                                           : pick(Inst::kIdKxorw, Inst::kIdKxorb),
                       x86::k(out), x86::k(out), x86::k(out));
        } else {
            code_.emit(
                conjunction ? pick(Inst::kIdKandw, Inst::kIdKandb) : pick(Inst::kIdKorw, Inst::kIdKorb),
                x86::k(out), x86::k(in[0]), x86::k(in[1]));
        }
    } else if (step.op == StepOp::mask_not) {
        code_.emit(Inst::kIdVxorps, vector(out), vector(in[0]), code_.ones());
    } else if (step.op == StepOp::mask_constant) {
        if (step.immediate != 0) {
            code_.emit(Inst::kIdVmovups, vector(out), code_.ones());
        } else {
            code_.emit(Inst::kIdVxorps, vector(out), vector(out), vector(out));
        }
    } else {
        code_.emit(conjunction ? Inst::kIdVandps : Inst::kIdVorps, vector(out), vector(in[0]), vector(in[1]));
    }
    hold(c, out, index);
}

void FunctionWriter::write_choose(std::uint32_t index, const Step& step) {
    const std::uint32_t mask = in_register(step.in[0]);
    const x86::Vec otherwise = vector(in_register(step.in[2]));
    const asmjit::Operand chosen = anywhere(step.in[1], following(index, 1));
    after_operands(index, step);
    const std::uint32_t out = take(vectors);
    if (wide_) {
        code_.assembler_.k(x86::k(mask));
        code_.emit(single_ ? Inst::kIdVblendmps : Inst::kIdVblendmpd, vector(out), otherwise, chosen);
    } else {
        code_.emit(single_ ? Inst::kIdVblendvps : Inst::kIdVblendvpd, vector(out), otherwise, chosen,
                   vector(mask));
    }
    hold(vectors, out, index);
}

}  // namespace frep::native

#endif  // FREP_HAS_JIT
