// Helpers of the engine tests: points in columns, engines by name, comparison of bits.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "frep/eval/evaluator.h"
#include "frep/math/bits.h"

namespace frep_test {

/// Equal bits, or both NaN.
inline bool same(double a, double b) {
    return (a != a && b != b) || frep::math::to_bits(a) == frep::math::to_bits(b);
}

inline bool same(const frep::math::Interval& a, const frep::math::Interval& b) {
    return a.maybe_undefined == b.maybe_undefined &&
           ((a.is_empty() && b.is_empty()) || (same(a.lo, b.lo) && same(a.hi, b.hi)));
}

/// Columns of numbers: column k holds value k of all points.
template <class T>
struct Columns {
    std::vector<std::vector<T>> columns;

    Columns(std::size_t count, std::size_t rows) : columns(count, std::vector<T>(rows)) {}
    std::vector<T*> out() {
        std::vector<T*> pointers;
        for (auto& column : columns) pointers.push_back(column.data());
        return pointers;
    }
    std::vector<const T*> in() const {
        std::vector<const T*> pointers;
        for (const auto& column : columns) pointers.push_back(column.data());
        return pointers;
    }
    std::size_t rows() const { return columns.empty() ? 0 : columns[0].size(); }
};

inline std::unique_ptr<frep::Evaluator> engine(const frep::Field& field, frep::Engine which,
                                               int registers = 0, std::int64_t max_steps = 1'000'000) {
    frep::EvaluatorOptions options;
    options.engine = which;
    options.compile_at_once = true;
    options.attributes = !field.attributes.empty();
    options.registers = registers;
    options.max_steps = max_steps;
    auto made = frep::make_evaluator(field, options);
    return made ? std::move(*made) : nullptr;
}

inline Columns<double> values_of(frep::Evaluator& evaluator, const Columns<double>& points,
                                 std::size_t rows) {
    Columns<double> out(static_cast<std::size_t>(evaluator.outputs()), rows);
    evaluator.values(points.in(), rows, out.out());
    return out;
}

/// Column 0: F; then its partial derivatives.
inline Columns<double> gradients_of(frep::Evaluator& evaluator, const Columns<double>& points,
                                    std::size_t rows) {
    Columns<double> out(static_cast<std::size_t>(evaluator.coordinates()) + 1, rows);
    auto pointers = out.out();
    evaluator.gradients(points.in(), rows, pointers[0], std::span(pointers).subspan(1));
    return out;
}

inline std::vector<frep::math::Interval> intervals_of(frep::Evaluator& evaluator,
                                                      const Columns<frep::math::Interval>& boxes,
                                                      std::size_t rows) {
    std::vector<frep::math::Interval> out(rows);
    evaluator.intervals(boxes.in(), rows, out.data());
    return out;
}

/// Number of rows times outputs where two tables differ.
inline std::size_t differences(const Columns<double>& a, const Columns<double>& b) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < a.columns.size(); ++k)
        for (std::size_t i = 0; i < a.columns[k].size(); ++i)
            count += !same(a.columns[k][i], b.columns[k][i]);
    return count;
}

/// 1, or `full` when the environment asks for the long run (FREP_FULL=1).
inline std::size_t scale(std::size_t full) {
    const char* wish = std::getenv("FREP_FULL");
    return wish && wish[0] == '1' ? full : 1;
}

}  // namespace frep_test
