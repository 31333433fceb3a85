// A field as an isosurface of POV-Ray 3.7 or later: its graph as functions of POV-Ray's scene language.
// POV-Ray is left-handed and takes f < 0 for the inside: y and z change places, and the function is -F.
// A node that several others use is computed once: cheap ones as a function of x, y, z, others as a parameter
// that is handed from function to function. POV-Ray has no undefined values: roots and logarithms of numbers
// below 0 are taken at the edge of their domain.
// Source: POV-Ray 3.7 reference, sections 3.3.1.8 (functions) and 3.5.1.1.4 (isosurface).
// Tested by tests/unit/lang/pov_isosurface_test.cpp, which evaluates the text.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "frep/base/result.h"
#include "frep/base/source.h"
#include "frep/field/field.h"
#include "frep/math/vec.h"

namespace frep::lang {

/// Where a coordinate of the field comes from: x, y, z of space (0, 1, 2), or a number (-1).
struct PovCoordinate {
    int axis = -1;
    double value = 0;
};

struct PovIsosurfaceOptions {
    Box3 box{{-10, -10, -10}, {10, 10, 10}};  ///< contained_by, in model space; the surface is closed there
    double max_gradient = 1;  ///< at least the length of the gradient near the surface, else there are holes
    std::array<double, 3> color{0.78, 0.76, 0.72};  ///< R, G, B in 0..1, sRGB
    std::vector<PovCoordinate> coordinates;         ///< one for each of the field; empty: x, y, z, others 0
    std::string title;                              ///< for a comment; may be empty
    const Source* source = nullptr;                 ///< the model's text, for places in messages
};

/// A scene file with the isosurface, a camera and a light; #include uses the object alone. Errors:
/// invalid_argument for an operation that POV-Ray cannot do (noise, regions, distances found by iteration,
/// tables), with its name and place; over_limit when the text is longer than 8 MiB or needs more values at
/// once than a function of POV-Ray has parameters.
Result<std::string> pov_isosurface(const Field& field, const PovIsosurfaceOptions& options);

}  // namespace frep::lang
