// Limits of the language, each with a diagnostic of its own (docs/language.md). They keep every file, hostile
// ones included, within seconds and a bounded memory.
#pragma once

#include <cstddef>
#include <cstdint>

namespace frep::lang {

inline constexpr std::size_t source_limit = 16u << 20;      ///< bytes of a source file
inline constexpr int nesting_limit = 256;                   ///< expressions and statements inside one another
inline constexpr std::size_t expression_limit = 4'000'000;  ///< nodes of the syntax tree
inline constexpr std::int64_t array_item_limit = 1'000'000;  ///< items of all arrays of an object
inline constexpr std::int64_t lowering_limit = 50'000'000;   ///< steps of the lowering
inline constexpr int call_depth_limit = 1000;                ///< objects that call one another in a row
inline constexpr int depth_limit = 8000;            ///< expressions, statements and calls inside one another
inline constexpr std::int64_t unroll_limit = 1000;  ///< steps of a loop that are unrolled
inline constexpr std::size_t unroll_node_limit = 200'000;  ///< nodes that one unrolled loop may make
inline constexpr std::size_t diagnostic_limit = 200;       ///< diagnostics kept of one run

}  // namespace frep::lang
