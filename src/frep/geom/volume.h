// Volume: samples of a function on a regular grid in space, plain data: what voxel files become.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "frep/math/vec.h"

namespace frep {

/// Sample (i, j, k) stands at origin + i axes[0] + j axes[1] + k axes[2]; values are x fastest:
/// values[(k ny + j) nx + i]. The three axes span space.
struct Volume {
    std::array<std::size_t, 3> size{};
    std::vector<double> values;
    Vec3 origin;
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
};

}  // namespace frep
