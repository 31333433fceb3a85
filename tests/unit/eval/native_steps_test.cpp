// The list of steps of native code, run step by step: what is known of a value (native_facts.cpp) holds for
// it at every point of the domain, in both formats, for random fields and for numbers at the edges; the
// result is that of the interpreters; the interleaved order keeps operands before users.
#include "frep/eval/native_steps.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "frep/eval/native_order.h"
#include "frep/eval/native_translate.h"
#include "unit/eval/engines.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using namespace frep_test;
using namespace frep::native;

namespace {

/// Runs a list at one point. Words are kept in 64 bits; a mask is 0 or 1.
class Walker {
  public:
    explicit Walker(const Translation& made) : made_(made), list_(made.list), values_(list_.steps().size()) {}

    const std::vector<std::uint64_t>& run(const std::vector<double>& point) {
        for (ValueId v = 0; v < values_.size(); ++v) values_[v] = value(list_.steps()[v], point) & kept(v);
        return values_;
    }
    double number(ValueId v) const { return number_of_bits(list_.single(), values_[v]); }

  private:
    std::uint64_t kept(ValueId v) const { return is_mask(list_.steps()[v].op) ? 1 : list_.word_mask(); }

    std::uint64_t value(const Step& step, const std::vector<double>& point) {
        const auto in = list_.operands_of(step);
        const bool single = list_.single();
        const auto bits = [&](std::size_t k) { return values_[in[k]]; };
        const auto real = [&](std::size_t k) { return number(in[k]); };
        const auto of = [single](double x) { return bits_of_number(single, x); };
        switch (step.op) {
            case StepOp::input:
                return of(point[step.bits]);
            case StepOp::constant:
                return step.bits;
            case StepOp::add:
            case StepOp::subtract:
            case StepOp::multiply:
            case StepOp::divide:
                return of(rounded_operation(single, step.op, real(0), real(1)));
            case StepOp::square_root:
                return of(rounded_operation(single, step.op, real(0), 0));
            case StepOp::lesser:
                return real(0) < real(1) ? bits(0) : bits(1);
            case StepOp::greater:
                return real(1) < real(0) ? bits(0) : bits(1);
            case StepOp::scale:
                return of(scaled(single, real(0), real(1)));
            case StepOp::round:
                return of(step.immediate == 1   ? std::floor(real(0))
                          : step.immediate == 2 ? std::ceil(real(0))
                                                : std::trunc(real(0)));
            case StepOp::bit_and:
            case StepOp::mask_and:
                return bits(0) & bits(1);
            case StepOp::bit_or:
            case StepOp::mask_or:
                return bits(0) | bits(1);
            case StepOp::bit_xor:
                return bits(0) ^ bits(1);
            case StepOp::word_add:
                return bits(0) + bits(1);
            case StepOp::word_subtract:
                return bits(0) - bits(1);
            case StepOp::shift_left:
                return bits(0) << step.immediate;
            case StepOp::shift_right:
                return bits(0) >> step.immediate;
            case StepOp::compare:
                return compare(static_cast<Predicate>(step.immediate), real(0), real(1));
            case StepOp::low_bit:
                return bits(0) & 1;
            case StepOp::mask_not:
                return bits(0) ^ 1;
            case StepOp::mask_constant:
                return step.immediate;
            case StepOp::choose:
                return bits(0) != 0 ? bits(1) : bits(2);
            case StepOp::patch:
                return patched(step);
            case StepOp::call:
                return called(step);
        }
        return 0;
    }
    /// x 2^floor(n), as the instruction has it: undefined where n is.
    static double scaled(bool single, double x, double n) {
        if (n != n) return n;
        const int power = static_cast<int>(std::clamp(std::floor(n), -5000.0, 5000.0));
        return single ? double{std::ldexp(static_cast<float>(x), power)} : std::ldexp(x, power);
    }
    static bool compare(Predicate p, double a, double b) {
        switch (p) {
            case Predicate::equal:
                return a == b;
            case Predicate::not_equal:
                return !(a == b);
            case Predicate::less:
                return a < b;
            case Predicate::not_less:
                return !(a < b);
            case Predicate::less_equal:
                return a <= b;
            case Predicate::not_less_equal:
                return !(a <= b);
            case Predicate::ordered:
                return a == a && b == b;
            default:
                return a != a || b != b;
        }
    }
    std::uint64_t patched(const Step& step) {
        alignas(64) std::array<std::uint64_t, 24> block{};
        for (std::size_t k = 1; k < step.count; ++k) block[8 * (k - 1)] = values_[step.in[k]];
        const auto* const function = reinterpret_cast<const void*>(static_cast<std::uintptr_t>(step.bits));
        const auto mask = static_cast<unsigned>(values_[step.in[0]]);
        const auto helper = list_.single() ? (step.count == 3 ? &patch_floats_1 : &patch_floats_2)
                                           : (step.count == 3 ? &patch_doubles_1 : &patch_doubles_2);
        helper(function, mask, block.data());
        return block[0];
    }
    std::uint64_t called(const Step& step) {
        const auto in = list_.operands_of(step);
        std::vector<std::uint64_t> block(8 * std::max<std::size_t>(in.size(), 1));
        for (std::size_t k = 0; k < in.size(); ++k) block[8 * k] = values_[in[k]];
        (list_.single() ? call_on_floats : call_on_doubles)(&made_.calls[step.bits], block.data());
        return block[0];
    }

    const Translation& made_;
    const StepList& list_;
    std::vector<std::uint64_t> values_;
};

bool holds(const Facts& facts, double value) {
    if (value != value) return facts.nan;
    if (value == 0 && !(std::signbit(value) ? facts.minus_zero : facts.plus_zero)) return false;
    return value >= facts.lo && value <= facts.hi;
}

/// Values that break what is known of them.
std::size_t broken_facts(const Translation& made, Walker& walker, const std::vector<double>& point) {
    walker.run(point);
    std::size_t broken = 0;
    for (ValueId v = 0; v < made.list.steps().size(); ++v)
        if (!is_mask(made.list.steps()[v].op) && made.list.steps()[v].op != StepOp::constant)
            broken += !holds(made.list.facts(v), walker.number(v));
    return broken;
}

Field random_field(std::uint64_t seed) {
    RandomOptions options;
    options.operations = 3 + static_cast<int>(seed % 60);
    options.region_percent = 0;
    options.attributes = 0;
    return RandomField(seed, options).make();
}

}  // namespace

TEST_CASE("what is known of values holds") {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const Field field = random_field(seed);
        const auto tape = make_clause_tape(field);
        Random random(seed);
        std::vector<math::Interval> domain;
        for (int i = 0; i < 3; ++i) {
            const double a = random.plain(3), b = random.plain(3);
            domain.emplace_back(std::min(a, b), std::max(a, b));
        }
        const auto reference = engine(field, Engine::reference);
        for (const bool single : {false, true}) {
            for (const bool everywhere : {false, true}) {
                const Translation made = translate(*tape, single, seed % 2 == 0,
                                                   everywhere ? std::span<const math::Interval>() : domain);
                Walker walker(made);
                for (int k = 0; k < 12; ++k) {
                    std::vector<double> point;
                    Columns<double> column(3, 1);
                    for (std::size_t i = 0; i < 3; ++i) {
                        const double inside = k == 0   ? domain[i].lo
                                              : k == 1 ? domain[i].hi
                                                       : random.real(domain[i].lo, domain[i].hi);
                        point.push_back(everywhere ? random_coordinate(random) : inside);
                        column.columns[i][0] = point.back();
                    }
                    INFO("seed ", seed, " single ", single, " everywhere ", everywhere);
                    CHECK(broken_facts(made, walker, point) == 0);
                    if (single) continue;
                    CHECK(same(walker.number(made.root), values_of(*reference, column, 1).columns[0][0]));
                }
            }
        }
    }
}

TEST_CASE("the interleaved order keeps operands before users") {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const auto tape = make_clause_tape(random_field(seed));
        const Translation made = translate(*tape, seed % 2 == 0, true, {});
        const auto& steps = made.list.steps();
        std::vector<ValueId> written;
        for (ValueId v = 0; v < steps.size(); ++v)
            if (steps[v].op != StepOp::constant && steps[v].op != StepOp::input) written.push_back(v);
        for (const std::uint32_t registers : {3u, 26u}) {
            const auto order = interleaved(made.list, written, registers, seed % 3 == 0 ? 0 : 6);
            std::vector<std::size_t> place(steps.size(), 0);
            REQUIRE(order.size() == written.size());
            for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i + 1;
            for (const ValueId v : written) {
                CHECK(place[v] != 0);
                for (const ValueId in : made.list.operands_of(steps[v])) CHECK(place[in] < place[v]);
            }
        }
    }
}

TEST_CASE("equal steps have one number, and a minimum of numbers is one step") {
    StepList list(false, true);
    const Facts unit{-1, 1, false, true, true};
    const ValueId x = list.input(0, unit), y = list.input(1, unit);
    const ValueId a = list.make(StepOp::subtract, x, list.constant(0.25));
    const ValueId b = list.make(StepOp::subtract, y, list.constant(0.25));
    CHECK(list.make(StepOp::subtract, x, list.constant(0.25)) == a);
    CHECK(list.make(StepOp::add, a, b) == list.make(StepOp::add, b, a));
    CHECK(list.steps()[list.minimum(a, b)].op == StepOp::lesser);
    CHECK(list.minimum(a, list.constant(2.0)) == a);
    // Zeros of both signs, and a value that may be NaN.
    CHECK(list.steps()[list.minimum(x, y)].op == StepOp::bit_or);
    const ValueId z = list.input(2, {});
    CHECK(list.steps()[list.minimum(a, list.make(StepOp::add, z, list.constant(1.0)))].op == StepOp::lesser);
    CHECK(list.make(StepOp::add, z, list.constant(0.0)) != z);
    CHECK(list.make(StepOp::subtract, z, list.constant(0.0)) == z);
    CHECK(list.compare(Predicate::less, a, list.constant(3.0)) == list.mask_constant(true));
    CHECK(list.steps()[list.compare(Predicate::less, z, list.constant(3.0))].op == StepOp::compare);
}
