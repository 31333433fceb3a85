// What statements read and write, found from the syntax tree alone. The lowering asks it which variables a
// loop may change (they become cells of a region) and which branches contain control flow that cannot be a
// plain selection. Tested by tests/unit/lang/lower_test.cpp.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "frep/lang/ast.h"

namespace frep::lang {

/// Variables of the object the statements belong to, by number.
struct Effects {
    std::set<std::uint32_t> scalars_read, scalars_written;
    std::set<std::uint32_t> arrays_read, arrays_written;
    bool has_loop = false;  ///< a while, here or in a called object
    bool has_computed_store =
        false;  ///< an item assigned by an index that is not a number, here or in a callee
    bool has_computed_load =
        false;  ///< an item read by an index that is not a number, here (callees excluded)

    /// Control flow that must be statements of a region rather than a selection between values.
    bool needs_statements() const { return has_loop || has_computed_store; }
    void merge(const Effects& other);
};

/// Effects of the statements and expressions of one program, computed once each.
class EffectsTable {
  public:
    explicit EffectsTable(const Program& program) : program_(program) {}

    /// `object`: the object that the statement or expression belongs to.
    const Effects& of_statement(const Object& object, StatementId id);
    Effects of_statements(const Object& object, const std::vector<StatementId>& ids);
    Effects of_expression(const Object& object, ExpressionId id);
    /// Only the flags of the object's body count for its callers.
    const Effects& of_object(std::uint32_t object);

  private:
    void add_expression(const Object& object, ExpressionId id, Effects& out);
    void add_library_call(const ExpressionNode& call, Effects& out);
    void add_object_call(const Object& caller, const ExpressionNode& call, Effects& out);

    const Program& program_;
    std::vector<std::optional<Effects>> statements_;
    std::vector<std::optional<Effects>> objects_;
};

}  // namespace frep::lang
