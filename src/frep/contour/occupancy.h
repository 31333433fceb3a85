// What a shape fills of a box, on a regular grid of samples: for measures of moving shapes, where many frames
// are compared and a few thousandths of the box are precise enough. Tested by
// tests/unit/contour/occupancy_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/field_pool.h"
#include "frep/math/vec.h"

namespace frep {

/// F >= 0 in the middle of each cell.
struct Occupancy {
    std::array<int, 3> cells{1, 1, 1};  ///< along x, y, z; x runs fastest; 1 along an axis without extent
    double cell_size = 0;               ///< volume of a cell, or its area where one axis has no extent
    std::vector<std::uint8_t> inside;

    /// Area or volume.
    double size() const;
    /// Parts that touch one another along a face (an edge in the plane).
    int components() const;
};

/// `longest` cells along the longest side of `box` (8..512), in the plane and in space; a side of length 0
/// has one cell. Errors: invalid_argument for a box without two sides, or a number out of range; cancelled.
Result<Occupancy> sample_occupancy(FieldPool& fields, const Box3& box, int longest, const Job& job);

/// Area or volume of what belongs to one of two samples of the same grid, not to both.
double difference(const Occupancy& a, const Occupancy& b);

}  // namespace frep
