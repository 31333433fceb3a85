// Tables of names; see names.h. Tested by tests/unit/lang/parser_test.cpp.
#include "frep/lang/names.h"

#include <array>
#include <string>
#include <unordered_map>

#include "frep/lang/lexer.h"

namespace frep::lang {
namespace {

constexpr std::array<BuiltinInfo, 23> builtins{{
    {"sqrt", Builtin::sqrt, 1},   {"exp", Builtin::exp, 1},   {"sin", Builtin::sin, 1},
    {"cos", Builtin::cos, 1},     {"atan", Builtin::atan, 1}, {"sinh", Builtin::sinh, 1},
    {"cosh", Builtin::cosh, 1},   {"tanh", Builtin::tanh, 1}, {"abs", Builtin::abs, 1},
    {"log", Builtin::log, 1},     {"logd", Builtin::logd, 1}, {"tan", Builtin::tan, 1},
    {"asin", Builtin::asin, 1},   {"acos", Builtin::acos, 1}, {"sign", Builtin::sign, 1},
    {"mod", Builtin::mod, 2},     {"max", Builtin::max, 2},   {"min", Builtin::min, 2},
    {"atan2", Builtin::atan2, 2}, {"ceil", Builtin::ceil, 1}, {"floor", Builtin::floor, 1},
    {"int", Builtin::integer, 1}, {"frac", Builtin::frac, 1},
}};

using LibraryIndex = std::unordered_map<std::string, std::span<const shapes::LibraryFunction>>;

LibraryIndex index_library() {
    LibraryIndex index;
    const auto rows = shapes::library();
    for (std::size_t i = 0; i < rows.size();) {
        const std::string name = lower_case(rows[i].name);
        std::size_t end = i + 1;
        while (end < rows.size() && lower_case(rows[end].name) == name) ++end;
        index.emplace(name, rows.subspan(i, end - i));
        i = end;
    }
    return index;
}

}  // namespace

std::span<const BuiltinInfo> builtin_table() { return builtins; }

const BuiltinInfo* find_builtin(std::string_view lower) {
    if (lower.size() > 5) return nullptr;
    for (const BuiltinInfo& builtin : builtins)
        if (builtin.name == lower) return &builtin;
    return nullptr;
}

std::span<const shapes::LibraryFunction> find_library(std::string_view lower) {
    static const LibraryIndex index = index_library();
    const auto found = index.find(std::string(lower));
    return found == index.end() ? std::span<const shapes::LibraryFunction>{} : found->second;
}

}  // namespace frep::lang
