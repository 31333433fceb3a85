// What happens in an animation: size, parts and change of every frame, and warnings about frames that are
// empty or jump. Tested by tests/cli/animate.txt.
#pragma once

#include <string>
#include <vector>

#include "animate_options.h"
#include "json.h"

namespace frep::cli {

struct FrameMeasure {
    double value = 0;  ///< of the moving coordinate or parameter
    double size = 0;   ///< area or volume
    int components = 0;
    double change = 0;  ///< size of the symmetric difference from the frame before; 0 for the first
};

/// Samples the model at all `values`, on a grid of `cells` along the longest side. Errors: as of
/// MovingModel::set() and sample_occupancy().
Result<std::vector<FrameMeasure>> measure_frames(MovingModel& model, const std::vector<double>& values,
                                                 const Box3& box, double iso, int cells, const Job& job);

/// `count` values of which each changes the shape as much as the next, from finely spaced measures. Where
/// nothing changes at all they are evenly spaced.
std::vector<double> even_values(const std::vector<FrameMeasure>& fine, int count);

/// Warns of empty frames, and of frames whose change is more than half of the mean size and more than four
/// times the median change.
void warn_about_frames(const std::vector<FrameMeasure>& frames, const std::string& name);

/// {"schema": "frep.animate/1", "along": ..., "unit": "area" or "volume", "frames": [...]}.
Json frame_report(const std::vector<FrameMeasure>& frames, const std::string& name, bool flat);

}  // namespace frep::cli
