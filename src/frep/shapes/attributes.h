// Attribute functions: colours and other attribute values that depend on the point. Arrays `o` are changed in
// place; where a condition depends on the point each item becomes a selection. Wrong array sizes give
// error_value with a warning. Colours are red, green, blue 0..1; hue in degrees. Sources: Schmitt, Pasko and
// Schlick 2001; Catmull and Rom 1974; Smith 1978. Tested by tests/unit/shapes/attributes_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// Wave between b1 and b2: lo + (hi - lo)(1 + sin(freq v))/2.
Expression wave(Build& build, Expression v, Expression b1, Expression b2, Expression freq);

/// Cells of size block + gap per axis: o = inblock strictly inside the block part on all axes, else ingap.
Expression checker_board(Build& build, Array x, Array block_size, Array gap, ArrayInOut o, Array in_block,
                         Array in_gap);

/// f1 | f2, and in the union the attributes of the operand that holds the point; where both do, by `mode`
/// 0 first, 1 second, 2 sum, 3 smaller, 4 larger.
Expression union_attributes(Build& build, Expression f1, Expression f2, ArrayInOut o, Array i1, Array i2,
                            Expression mode);

/// o = (r, g, b) where f >= 0.
Expression set_color(Build& build, Expression f, ArrayInOut o, Expression r, Expression g, Expression b);

/// The first items of o = those of i where f >= 0.
Expression set_attributes(Build& build, Expression f, ArrayInOut o, Array i);

/// o = mix of i1 and i2 by t = (f - fmin)/(fmax - fmin), clamped; returns t, not clamped. With `cubic` the
/// weight is t^2 (3 - 2 t).
template <bool cubic>
Expression mix(Build& build, ArrayInOut o, Array i1, Array i2, Expression f, Expression fmin,
               Expression fmax);

/// f clamped to a..b; 0 below a and 1 from a on; 1 in lo..hi and 0 elsewhere; smooth step from a to b.
Expression clamp(Build& build, Expression f, Expression a, Expression b);
Expression step(Build& build, Expression f, Expression a);
Expression pulse_old(Build& build, Expression f, Expression high, Expression low);
Expression pulse(Build& build, Expression f, Expression low, Expression high);
Expression smooth_step(Build& build, Expression f, Expression a, Expression b);
Expression smooth_step_old(Build& build, Expression, Expression, Expression, Expression f, Expression a,
                           Expression b);

/// a - trunc(a/b) b, plus b where that is negative; trunc a; floor a.
Expression modulo(Build& build, Expression a, Expression b);
Expression floor_old(Build& build, Expression a);
Expression floor_down(Build& build, Expression a);

/// Rows of `rows` (as long as o) at increasing numbers `map`: the row of the last number <= t. Below the
/// first number the last row (old) or the first (`first_below`); with `smooth`, a mix of two rows.
template <bool smooth, bool first_below>
Expression look_up(Build& build, Expression t, ArrayInOut o, Array rows, Array map);

/// Concentric rings: look-up by the fractional part of |x|; o stays outside the table. With `overwrite`,
/// item number size(map)+1 of the table counts as 1.1.
template <bool overwrite>
Expression circles(Build& build, Array x, ArrayInOut o, Array rows, Array map);

/// Crackled glaze: look-up by a function of three Gardner noises.
template <bool overwrite>
Expression crackles(Build& build, Array x, ArrayInOut o, Expression freq, Array rows, Array map);

/// Catmull-Rom curve through the rows of `list`, rows as long as o, for v in vmin..vmax.
Expression spline(Build& build, ArrayInOut o, Array list, Expression v, Expression vmin, Expression vmax);

/// Colour models. With `wrapped`, hue is in 0..360.
template <bool wrapped>
Expression rgb_to_hsv(Build& build, Array rgb, ArrayInOut hsv);
Expression hsv_to_rgb(Build& build, Array hsv, ArrayInOut rgb);

}  // namespace frep::shapes
