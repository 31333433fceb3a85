// The list of machine-like operations between a clause tape and native code: in single assignment, with equal
// operations numbered once, constants folded and what is known of the values used. Nothing here changes a
// bit: an operation is replaced only by one with the same result for every operand that the known facts
// allow. Method: value numbering (Cocke and Schwartz 1970) and forward ranges of the rounded operations,
// which are monotone. Tested by tests/unit/eval/native_steps_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace frep::native {

using ValueId = std::uint32_t;
inline constexpr ValueId no_value = std::numeric_limits<ValueId>::max();

/// Lane by lane. Values are reals, their bits as words, or masks.
enum class StepOp : std::uint8_t {
    input,     ///< bits = number of the input
    constant,  ///< bits = the number's
    add,       ///< from here to divide: IEEE operations
    subtract,
    multiply,
    divide,
    square_root,
    lesser,   ///< a < b ? a : b, so b where one is NaN or both are 0: the machine's minimum
    greater,  ///< b < a ? a : b
    round,    ///< immediate = Rounding
    scale,    ///< a * 2^b for an integer b, rounded once (AVX-512)
    bit_and,
    bit_or,
    bit_xor,
    word_add,  ///< modulo 2^32 or 2^64
    word_subtract,
    shift_left,  ///< immediate = places; zeros come in
    shift_right,
    compare,  ///< immediate = Predicate; gives a mask
    low_bit,  ///< mask of the lowest bit
    mask_and,
    mask_or,
    mask_not,
    mask_constant,  ///< immediate = 0 or 1
    choose,         ///< mask ? a : b
    patch,          ///< (mask, r, x[, y]): f(x[, y]) where the mask holds, else r; bits = address of f
    call,           ///< a clause by its meaning; operands are listed; bits = number of the call
};

/// As the processor numbers them, for an unsigned comparison that signals nothing.
enum class Predicate : std::uint8_t {
    equal = 0x00,
    unordered = 0x03,
    not_equal = 0x04,
    ordered = 0x07,
    less = 0x11,
    less_equal = 0x12,
    not_less = 0x15,
    not_less_equal = 0x16,
    not_greater_equal = 0x19,
    not_greater = 0x1a,
    greater_equal = 0x1d,
    greater = 0x1e
};
enum class Rounding : std::uint8_t { down = 1, up = 2, to_zero = 3 };

/// What is known of a value at every point that the code will see.
struct Facts {
    double lo = -std::numeric_limits<double>::infinity();
    double hi = std::numeric_limits<double>::infinity();  ///< bounds where it is a number
    bool nan = true;                                      ///< may be NaN
    bool plus_zero = true, minus_zero = true;             ///< may be that zero

    bool may_be_zero() const { return plus_zero || minus_zero; }
    /// May have the sign bit clear, or set (NaN aside).
    bool may_be_plus() const { return hi > 0 || plus_zero; }
    bool may_be_minus() const { return lo < 0 || minus_zero; }
    bool finite() const {
        return lo > -std::numeric_limits<double>::infinity() && hi < std::numeric_limits<double>::infinity();
    }
};

struct Step {
    StepOp op = StepOp::constant;
    std::uint8_t immediate = 0;
    std::uint8_t count = 0;  ///< operands in `in`; those of a call are listed
    ValueId in[4] = {no_value, no_value, no_value, no_value};
    std::uint64_t bits = 0;

    friend bool operator==(const Step&, const Step&) = default;
};

inline bool is_mask(StepOp op) {
    return op == StepOp::compare || (op >= StepOp::low_bit && op <= StepOp::mask_constant);
}

/// The list. Values are numbers of steps. `single`: reals are binary32 and words have 32 bits.
class StepList {
  public:
    /// `has_scale`: the machine has StepOp::scale.
    StepList(bool single, bool has_scale);

    bool single() const { return single_; }
    const std::vector<Step>& steps() const { return steps_; }
    const Facts& facts(ValueId v) const { return facts_[v]; }
    std::span<const ValueId> operands_of(const Step& step) const {
        if (step.op == StepOp::call) return {listed_.data() + step.in[0], step.in[1]};
        return {step.in, step.count};
    }

    /// A number given by its bits, or rounded to the type of the list.
    ValueId constant_bits(std::uint64_t bits);
    ValueId constant(double number);
    ValueId input(std::uint32_t number, const Facts& facts);
    /// Arithmetic and bit operations of one or two operands.
    ValueId make(StepOp op, ValueId a, ValueId b = no_value, std::uint8_t immediate = 0);
    ValueId compare(Predicate predicate, ValueId a, ValueId b);
    ValueId mask_not(ValueId m);
    ValueId mask_constant(bool truth);
    ValueId choose(ValueId mask, ValueId a, ValueId b);
    /// min and max of numerics.md, rule 5: NaN if either is, -0 below +0.
    ValueId minimum(ValueId a, ValueId b);
    ValueId maximum(ValueId a, ValueId b);
    ValueId patch(ValueId mask, ValueId r, ValueId x, ValueId y, const void* function);
    ValueId call(std::uint32_t number, std::span<const ValueId> operands);
    /// Adds what is known of a value from elsewhere.
    void refine(ValueId v, const Facts& facts);

    bool is_constant(ValueId v) const { return steps_[v].op == StepOp::constant; }
    std::uint64_t bits_of(ValueId v) const { return steps_[v].bits; }
    /// The number of a constant.
    double number_of(ValueId v) const;
    std::uint64_t sign_bit() const { return single_ ? 0x80000000u : 0x8000000000000000u; }
    std::uint64_t word_mask() const { return single_ ? 0xffffffffu : ~std::uint64_t{0}; }

  private:
    ValueId number(const Step& step, const Facts& facts);
    ValueId append(const Step& step, const Facts& facts);
    void grow_table();
    ValueId fold_constants(StepOp op, ValueId a, ValueId b, std::uint8_t immediate);
    ValueId simplify(StepOp op, ValueId a, ValueId b, std::uint8_t immediate);
    ValueId simplify_masks(StepOp op, ValueId a, ValueId b);
    ValueId find_scale(ValueId product, ValueId second);
    bool is_step(ValueId v, StepOp op, std::uint64_t second, int places = 0) const;
    ValueId extremum(StepOp op, ValueId a, ValueId b);
    bool is_number(ValueId v, double number) const;

    bool single_, has_scale_;
    std::vector<Step> steps_;
    std::vector<Facts> facts_;
    std::vector<ValueId> listed_;
    std::vector<ValueId> table_;  ///< open addressing; no_value = free
};

/// The facts of an operation's result from those of its operands; `b_bits`: of the second operand where it is
/// a constant. `same`: both operands are one value.
Facts facts_of_step(const StepList& list, StepOp op, ValueId a, ValueId b, std::uint8_t immediate);
/// The facts of a constant.
Facts facts_of_number(double number);
/// What holds for both.
Facts hull_of(const Facts& a, const Facts& b);

/// Bits of a number in the type of the list, and back; both exact where the number is of that type.
std::uint64_t bits_of_number(bool single, double number);
double number_of_bits(bool single, std::uint64_t bits);

/// The IEEE operation in the type of the list, rounded once.
double rounded_operation(bool single, StepOp op, double a, double b);

}  // namespace frep::native
