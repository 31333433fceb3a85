// SampledField: what meshes and pictures ask of a field: values, gradients, attributes and signs over boxes
// in 3-D space, in batches. The adaptor over eval's Evaluator puts a model of n coordinates into space
// (`--map`: a coordinate is an axis or frozen) and shifts by the iso value. One object serves one thread;
// clone() makes one for another. Tested by tests/unit/eval/sampled_field_test.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "frep/base/result.h"
#include "frep/eval/evaluator.h"
#include "frep/math/vec.h"

namespace frep {

/// Points of space as three arrays of one length, in model units.
struct PointSpans {
    std::span<const double> x, y, z;
    std::size_t size() const { return x.size(); }
};

/// Three arrays that receive partial derivatives.
struct GradientSpans {
    std::span<double> x, y, z;
};

/// What the function may be somewhere in a box. Never says "no" wrongly; may say "yes" for nothing.
struct SignRange {
    bool can_be_inside = true;     ///< defined and >= 0
    bool can_be_outside = true;    ///< defined and < 0
    bool can_be_undefined = true;  ///< NaN
};

class SampledField {
  public:
    virtual ~SampledField() = default;
    virtual std::unique_ptr<SampledField> clone() const = 0;
    /// out[p] = F at point p; NaN where undefined.
    virtual void values(const PointSpans& points, std::span<double> out) = 0;
    /// values[p] = F and out.*[p] = its partial derivatives by x, y, z.
    virtual void gradients(const PointSpans& points, std::span<double> values, const GradientSpans& out) = 0;
    /// The attributes s[1], s[2], ... that attributes() computes.
    virtual std::size_t attribute_count() const { return 0; }
    /// out[k][p] = attribute k (0 = s[1]) at point p, for the first out.size() <= attribute_count() of them;
    /// NaN where undefined.
    virtual void attributes(const PointSpans& points, std::span<const std::span<double>> out);
    /// out[b] = the signs that F may take in the closed box b.
    virtual void ranges(std::span<const Box3> boxes, std::span<SignRange> out) = 0;
    /// As ranges(), for many boxes at a time: sooner, and bounds may be wider by some parts in a million.
    virtual void quick_ranges(std::span<const Box3> boxes, std::span<SignRange> out) { ranges(boxes, out); }
    /// True where ranges cost much more than values do, so that samples find a surface sooner than proofs do:
    /// a field that cannot be narrowed, or has sums of many terms.
    virtual bool has_dear_ranges() const { return true; }
    /// True where narrow() finds smaller parts: a field without loops that depend on the point, whose ranges
    /// cost thousands of values.
    virtual bool can_be_narrowed() const { return false; }
    /// ranges(), and what stands for F in the boxes where its sign is open: parts[b] has the sign of F at
    /// every point of box b, is undefined where F is, and has the gradient of F where F = 0; its other values
    /// may differ from those of F, also between boxes. Null where that would gain nothing over this object.
    /// A part may be narrowed again. Parts serve the thread of this object and must not outlive it.
    virtual void narrow(std::span<const Box3> boxes, std::span<SignRange> out,
                        std::span<std::shared_ptr<SampledField>> parts);
    /// near[b] = a field whose values in box b have the sign of this one's at every point, and are undefined
    /// where those are, sooner than with this one. Their size says about how near the surface is, no more.
    /// Null where that would gain nothing. As parts, else.
    virtual void narrow_signs(std::span<const Box3> boxes, std::span<std::shared_ptr<SampledField>> near);
};

/// A box and what stands for F there; null: the field that was asked first.
struct FieldPart {
    Box3 box;
    std::shared_ptr<SampledField> field;
};

/// ranges[i] = the signs of F in parts[i].box, found through parts[i].field, which is then narrowed where
/// that gains something. Parts that follow each other with one field are judged together.
void narrow_parts(SampledField& whole, std::span<FieldPart> parts, std::span<SignRange> ranges);

/// near[i] = what narrow_signs() gives for parts[i].
void narrow_signs(SampledField& whole, std::span<const FieldPart> parts,
                  std::span<std::shared_ptr<SampledField>> near);

/// Where a coordinate of a model comes from: an axis of space or a frozen value.
struct MappedCoordinate {
    int axis = -1;     ///< 0, 1, 2 for x, y, z; -1: frozen
    double value = 0;  ///< of a frozen coordinate
};

/// One entry for each coordinate of the model, in order. The same axis may feed several coordinates.
struct AxisMap {
    std::vector<MappedCoordinate> coordinates;

    /// The first three coordinates are x, y, z; further ones are frozen at 0.
    static AxisMap standard(int count);
    /// True when a coordinate takes this axis (0, 1, 2).
    bool uses(int axis) const;
};

/// F(mapped point) - iso as a field in space. Takes the evaluator over. Errors: invalid_argument when the map
/// has not one entry for each coordinate of the evaluator, an axis other than -1..2, or a number that is not
/// finite.
Result<std::unique_ptr<SampledField>> make_sampled_field(std::unique_ptr<Evaluator> evaluator,
                                                         const AxisMap& map, double iso = 0);

}  // namespace frep
