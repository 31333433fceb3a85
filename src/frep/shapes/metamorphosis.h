// Metamorphosis: shapes that turn into others. Linear and bilinear mixing of functions (thesis 1.4), and
// space-time bounded blending (Pasko, Pasko and Kunii 2004; thesis 2.2): shape 1 as a half-cylinder in time
// that ends at t1, shape 2 as one that begins at t2, united by a bounded blend within a slab of time or a
// solid of space and time; the section at t is the frame. No correspondence of the shapes is needed, and they
// may lie apart and have any topology. All set operations are those of R0. Tested by
// tests/unit/shapes/metamorphosis_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// g until time t1: g & (t1 - t).
Expression half_cylinder_before(Expression g, Expression t, Expression t1);
/// g from time t2: g & (t - t2).
Expression half_cylinder_after(Expression g, Expression t, Expression t2);

/// The same with an end that is rounded by a bounded blending intersection (b0 < 0 takes material away):
/// the shape shrinks from time `begins` on, before it ends at t1 (or grows until `ends`, after t2); outside
/// of this span of time it is the plain half-cylinder, bit for bit. Remedy of the rapid transition (thesis
/// 2.2.3).
struct Smoothing {
    Expression b0, b1, b2, b3;
};
Expression smooth_half_cylinder_before(Expression g, Expression t, Expression t1, const Smoothing& s,
                                       Expression begins);
Expression smooth_half_cylinder_after(Expression g, Expression t, Expression t2, const Smoothing& s,
                                      Expression ends);

/// (t - low) & (high - t).
Expression time_slab(Expression t, Expression low, Expression high);

}  // namespace frep::shapes
