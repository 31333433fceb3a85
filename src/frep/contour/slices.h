// slice_layers: a solid in layers for layered manufacturing, by contour_2d.h in the middle of every layer.
// Heights are multiples of the layer's thickness, whatever the box is: layer k fills (k - 1) L to k L.
// Tested by tests/unit/contour/slices_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "frep/contour/contour_2d.h"
#include "frep/geom/polyline.h"

namespace frep {

/// The most layers of one solid.
inline constexpr std::int64_t max_layers = 1'000'000;

struct SlicingOptions {
    PlaneContourOptions contour;  ///< bounds, cells, cap, limits; its plane is not used
    double thickness = 1;         ///< of a layer, model units
};

struct Slicing {
    /// From the lowest layer with an outline to the highest, also the empty ones between. `z` is the height
    /// of the layer's top; the outlines are those in its middle, so that the volume is right to second order.
    std::vector<Slice> slices;
    std::uint64_t undefined_points = 0;
    std::optional<Vec3> first_undefined;
    std::array<bool, 6> touches{};  ///< sides of the box that the shape reaches in some layer
};

/// Layers whose middle lies in the box. Errors: as contour_plane(), over_limit for more than max_layers or
/// more points than the memory limit allows.
Result<Slicing> slice_layers(const SampledField& field, const SlicingOptions& options, const Job& job);

}  // namespace frep
