// The names that the language brings along: its built-in functions, and the FRep library by lower-case name.
// hyperfun.md a.5. Tested by tests/unit/lang/parser_test.cpp.
#pragma once

#include <span>
#include <string_view>

#include "frep/lang/ast.h"

namespace frep::lang {

struct BuiltinInfo {
    std::string_view name;
    Builtin builtin;
    int arity;
};

/// All built-in functions, in the order of the enumeration.
std::span<const BuiltinInfo> builtin_table();

/// The built-in function of that lower-case name, or nullptr.
const BuiltinInfo* find_builtin(std::string_view lower);

/// The library's rows of that lower-case name, in constant time; empty when there is none.
std::span<const shapes::LibraryFunction> find_library(std::string_view lower);

}  // namespace frep::lang
