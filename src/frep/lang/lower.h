// lower(): syntax tree -> expression graph, by partial evaluation. Objects are inlined (calls with equal
// arguments once), loops with a known trip count are unrolled, branches become selections, and a loop that
// depends on the point becomes one region. Expressions are evaluated from last to first, as the old
// interpreter does, so that in-place transforms inside an expression mean what they meant (hyperfun.md a.5).
// Tested by tests/unit/lang/lower_test.cpp and tests/conformance.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frep/base/diagnostic.h"
#include "frep/field/field.h"
#include "frep/field/lift.h"
#include "frep/lang/ast.h"
#include "frep/lang/limits.h"

namespace frep::lang {

struct LowerOptions {
    std::vector<double> parameters;  ///< values of a[1], a[2], ...; missing ones are 0
    /// Content of a file named relative to the model's folder, for library functions that read one.
    std::function<Result<std::string>(std::string_view)> read_file;
    std::int64_t step_limit = lowering_limit;  ///< steps of the lowering before it gives up (HF102)
};

struct Lowered {
    Field field;
    std::vector<bool> structural;  ///< parameter i decided a loop or an index: another value lowers anew
    std::vector<std::string> functions;  ///< library functions used, sorted
    std::size_t operations_before = 0;   ///< expressions evaluated by the lowering
    bool has_regions = false;            ///< loops that depend on the point
    LiftReport lifted;                   ///< set operations that the text spells out; filled by Model
};

/// The field of object number `object`. Nothing when an error was added to `diagnostics`.
std::optional<Lowered> lower(const Program& program, std::size_t object, const LowerOptions& options,
                             Diagnostics& diagnostics);

}  // namespace frep::lang
