// The enumeration of operations and its table, both made from field/ops.def.
#pragma once

#include <cstdint>
#include <string_view>

namespace frep {

enum class Op : std::uint8_t {
#define FREP_OP(name, kind, arity, cost, context, doc) name,
#include "frep/field/ops.def"
#undef FREP_OP
};

enum class OpKind : std::uint8_t { leaf, plain, block };
enum class OpContext : std::uint8_t { same, value };

/// A row of the op table; field/ops.def explains the columns.
struct OpInfo {
    std::string_view name;
    OpKind kind;
    int arity;
    int cost;
    OpContext context;
    std::string_view doc;
};

inline constexpr OpInfo op_table[] = {
#define FREP_OP(name, kind, arity, cost, context, doc) \
    {#name, OpKind::kind, arity, cost, OpContext::context, doc},
#include "frep/field/ops.def"
#undef FREP_OP
};

inline constexpr int op_count = static_cast<int>(sizeof(op_table) / sizeof(op_table[0]));

constexpr const OpInfo& info(Op op) { return op_table[static_cast<int>(op)]; }

}  // namespace frep
