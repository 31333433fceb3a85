// The syntax tree of a HyperFun file: plain data, made by parse() and read by lower(). Names are resolved
// (scalars and arrays by number within their object, calls by object or library row); nothing is evaluated
// yet. Expressions and statements live in pools of the Program and refer to each other by index, so that
// chains of any length and files of any size are plain loops; nesting is limited (see limits.h). Tested by
// tests/unit/lang/parser_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frep/base/source.h"
#include "frep/shapes/library.h"

namespace frep::lang {

using ExpressionId = std::uint32_t;
using StatementId = std::uint32_t;

enum class Operator : std::uint8_t {
    add,
    subtract,
    unite,
    intersect,
    subtract_solid,
    product,  // + - | & \ @ : one level of precedence
    multiply,
    divide,  // * /
    power,   // ^
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    not_equal,
    logical_and,
    logical_or,  // one level of precedence
    plus,
    minus,
    complement,
    logical_not,  // unary: + - ~ not
};

/// Functions of the language itself (hyperfun.md a.5, table of built-in functions).
enum class Builtin : std::uint8_t {
    sqrt,
    exp,
    sin,
    cos,
    atan,
    sinh,
    cosh,
    tanh,
    abs,
    log,
    logd,
    tan,
    asin,
    acos,
    sign,
    mod,
    max,
    min,
    atan2,
    ceil,
    floor,
    integer,
    frac,
};

enum class ExpressionKind : std::uint8_t {
    number,   ///< value
    text,     ///< text (index into Program::texts); only as a library argument
    scalar,   ///< symbol: number of the scalar in its object
    item,     ///< symbol: number of the array; operands[0] is the index
    array,    ///< symbol: number of the array; only as an argument of a call
    unary,    ///< operators[0] applied to operands[0]
    chain,    ///< left-associative: operands[0] operators[0] operands[1] operators[1] ... of one precedence
    builtin,  ///< builtin(operands...)
    library_call,  ///< function (a library row); operands, arrays as kind array
    object_call,   ///< symbol: number of the object; operands: 2 or 3 of kind array
};

struct ExpressionNode {
    ExpressionKind kind = ExpressionKind::number;
    Builtin builtin = Builtin::sqrt;
    std::uint32_t symbol = 0;
    double value = 0;
    const shapes::LibraryFunction* function = nullptr;
    std::vector<ExpressionId> operands;
    std::vector<Operator> operators;
    std::vector<Span> operator_spans;  ///< same size as operators
    Span span;
};

enum class StatementKind : std::uint8_t {
    assign,       ///< scalar `symbol` = value
    assign_item,  ///< array `symbol`[index] = value: value first, then the index
    assign_list,  ///< array `symbol` = [list]; list has the array's size
    branch,       ///< if value then first else second
    loop,         ///< while value: first
    result,       ///< the object's own name = value; the last statement of the body
};

struct StatementNode {
    StatementKind kind = StatementKind::assign;
    std::uint32_t symbol = 0;
    ExpressionId value = 0;
    ExpressionId index = 0;
    std::vector<ExpressionId> list;
    std::vector<StatementId> first;
    std::vector<StatementId> second;
    Span span;         ///< the statement
    Span target_span;  ///< what is assigned
};

struct ArrayInfo {
    std::string name;  ///< lower case
    std::uint32_t size = 0;
    Span span;
};

/// Arrays 0, 1, 2 of an object are x, a and s; locals follow.
inline constexpr std::uint32_t array_x = 0, array_a = 1, array_s = 2;

struct Object {
    std::string name;          ///< lower case
    std::string written_name;  ///< as in the file
    Span name_span;
    std::vector<ArrayInfo> arrays;
    std::vector<std::string> scalars;  ///< lower case
    bool declares_attributes = false;  ///< the header has s[k]
    std::vector<StatementId> body;     ///< ends with the result statement

    int coordinates() const { return static_cast<int>(arrays[array_x].size); }
    int parameters() const { return static_cast<int>(arrays[array_a].size); }
    int attributes() const { return static_cast<int>(arrays[array_s].size); }
};

/// A `--@ param` line: a[index], its name, range, default and description.
struct ParameterAnnotation {
    int index = 1;
    std::string name;
    bool has_range = false;
    double low = 0, high = 0;
    bool has_default = false;
    double value = 0;
    std::string description;
    Span span;
};

/// The `--@` annotations of a file (cli.md, Annotations).
struct Annotations {
    std::string title, author, license, source, units;
    std::vector<double> bounds;  ///< 2 n numbers: min max for each axis; empty when absent
    std::vector<double> color;   ///< 3 numbers 0..1 (sRGB); empty when absent
    std::string material;        ///< of pictures, lower case; empty when absent
    std::vector<double> view;    ///< of pictures: azimuth and elevation in degrees; empty when absent
    std::vector<ParameterAnnotation> parameters;
    shapes::SetSystem set_operations;  ///< what the operators | & \ @ mean
    int dialect = 2;                   ///< 3 after `--@ hyperfun 3` as the first line
};

struct Program {
    std::vector<Object> objects;
    std::vector<ExpressionNode> expressions;
    std::vector<StatementNode> statements;
    std::vector<std::string> texts;
    Annotations annotations;
};

}  // namespace frep::lang
