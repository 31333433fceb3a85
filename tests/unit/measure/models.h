// Fields of HyperFun texts for the tests of measures.
#pragma once

#include <doctest/doctest.h>

#include <string>

#include "frep/frep.h"

namespace frep::test {

/// The field of the one object whose body is `body`, with the coordinates x[1..n].
inline Field field_of(const std::string& body, int coordinates = 3) {
    const auto model = compile("my_model(x[" + std::to_string(coordinates) + "], a[1]) {\n" + body + "\n}\n");
    if (!model) FAIL(model.error().message);
    const auto field = model->field();
    if (!field) FAIL(field.error().message);
    return *field;
}

/// The same in space.
inline Field space_field_of(const std::string& body, int coordinates = 3) {
    const auto field = field_in_space(field_of(body, coordinates), AxisMap::standard(coordinates));
    if (!field) FAIL(field.error().message);
    return *field;
}

/// True when the interval holds the number.
inline bool holds(const math::Interval& v, double number) { return v.lo <= number && number <= v.hi; }

}  // namespace frep::test
