// How a C++ builder becomes a row of the library table: kinds of arguments and the thunk that unpacks them
// are deduced from the builder's signature, so that table and code cannot disagree. Small helpers that many
// builders share stand here too. Tested by tests/unit/shapes/table_test.cpp.
#pragma once

#include <initializer_list>
#include <type_traits>
#include <utility>

#include "frep/shapes/library.h"

namespace frep::shapes {

namespace detail {

template <class Argument>
constexpr ArgumentKind kind_of() {
    if constexpr (std::is_same_v<Argument, Expression>) {
        return ArgumentKind::number;
    } else if constexpr (std::is_same_v<Argument, Array>) {
        return ArgumentKind::array;
    } else if constexpr (std::is_same_v<Argument, ArrayInOut>) {
        return ArgumentKind::array_in_out;
    } else {
        static_assert(std::is_same_v<Argument, std::string_view>, "no kind of argument");
        return ArgumentKind::text;
    }
}

template <class Argument>
Argument unpack(ArgumentValue& value) {
    if constexpr (std::is_same_v<Argument, Expression>) {
        return value.number;
    } else if constexpr (std::is_same_v<Argument, std::string_view>) {
        return value.text;
    } else {
        return Argument(value.items);
    }
}

template <class>
struct Signature;
template <class... Arguments>
struct Signature<Expression (*)(Build&, Arguments...)> {
    static constexpr std::size_t arity = sizeof...(Arguments);
    static constexpr ArgumentKind kinds[arity] = {kind_of<Arguments>()...};

    template <auto builder, std::size_t... index>
    static Expression call(Build& build, std::span<ArgumentValue> values, std::index_sequence<index...>) {
        return builder(build, unpack<Arguments>(values[index])...);
    }
};

template <auto builder>
Expression invoke(Build& build, std::span<ArgumentValue> values) {
    using Shape = Signature<decltype(builder)>;
    FREP_CHECK(values.size() == Shape::arity);
    return Shape::template call<builder>(build, values, std::make_index_sequence<Shape::arity>());
}

/// The next name of a list "x, center, R"; the list loses it.
std::string_view next_name(std::string_view& names);

}  // namespace detail

/// The texts of a row; LibraryFunction explains them.
struct RowText {
    std::string_view doc;
    std::string_view formula;
    std::string_view citation = {};
    std::string_view note = {};
};

/// A row for `builder`. `names`: the argument names, "x, center, R"; one for every argument.
template <auto builder>
LibraryFunction row(std::string_view name, std::string_view names, RowText text, bool reserved = true) {
    using Shape = detail::Signature<decltype(builder)>;
    LibraryFunction function;
    function.name = name;
    for (const ArgumentKind kind : Shape::kinds)
        function.arguments.push_back({detail::next_name(names), kind});
    FREP_CHECK(names.empty());
    function.invoke = &detail::invoke<builder>;
    function.doc = text.doc;
    function.formula = text.formula;
    function.citation = text.citation;
    function.note = text.note;
    function.reserved = reserved;
    return function;
}

/// The rows of one group, in order; joined in library.cpp.
using Rows = std::vector<LibraryFunction>;
Rows primitive_rows();
Rows skeleton_rows();
Rows convolution_rows();
Rows freeform_rows();
Rows transform_rows();
Rows affine_rows();
Rows deformation_rows();
Rows pattern_rows();
Rows set_operation_rows();
Rows blend_rows();
Rows control_point_rows();
Rows offset_rows();
Rows metamorphosis_rows();
Rows radial_morph_rows();
Rows polygon_rows();
Rows outline_rows();
Rows volume_rows();
Rows extremum_rows();
Rows sweep_rows();
Rows distance_rows();
Rows noise_rows();
Rows hypertexture_rows();
Rows attribute_rows();
Rows attribute_table_rows();

// Helpers of builders.

/// True when every array has the wanted number of items.
inline bool sizes_are(std::initializer_list<std::pair<Array, std::size_t>> arrays) {
    for (const auto& [array, size] : arrays)
        if (array.size() != size) return false;
    return true;
}

/// `value` where `bad` is false, error_value where it is true; a known truth is decided (and warned of) now.
Expression guarded(Build& build, Expression bad, const std::string& message, Expression value);

/// The number of an expression that is one number for every point: with the present parameters, which become
/// structural.
std::optional<double> known(Build& build, Expression value);

/// An op of kind block on leading arguments and data items.
Expression block(Build& build, Op op, std::initializer_list<Expression> lead,
                 std::span<const Expression> data);

/// A point or vector of expressions.
struct Vec3x {
    Expression x, y, z;
};
/// The first three items.
inline Vec3x vec3(Array a) { return {a[0], a[1], a[2]}; }
inline Vec3x operator-(Vec3x a, Vec3x b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
/// The scalar product.
inline Expression dot(Vec3x a, Vec3x b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// The vector product.
inline Vec3x cross(Vec3x a, Vec3x b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The square of the Euclidean length.
inline Expression norm2(Vec3x a) { return square(a.x) + square(a.y) + square(a.z); }

/// What "wrong sizes" of the usual arguments is called in a warning.
inline constexpr const char* needs_3d = "x and the centre must have 3 items each";

}  // namespace frep::shapes
