// The search for what one blend changes: cells that may change, found with pruned tapes, and samples in them.
// Used by blend_check.cpp. Tested by tests/unit/measure/blend_check_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "frep/base/job.h"
#include "frep/eval/batch_vm.h"
#include "frep/eval/prune.h"
#include "frep/measure/blend_fields.h"
#include "frep/measure/measured_box.h"

namespace frep::measuring {

/// A sample's place in the lattice of samples.
using SampleIndex = std::array<std::uint16_t, 3>;

/// What a blend does.
struct BlendMap {
    bool acts = false;         ///< a sample that it changes was found
    bool never_acts = false;   ///< proved
    std::uint32_t finest = 0;  ///< samples along the longest side of the box, if they were looked at
    /// The samples that it changes, by connected part, the largest first; parts far smaller than the first
    /// are left out, as ragged ends of it. Empty unless asked for.
    std::vector<std::vector<SampleIndex>> parts;
};

/// Serves one thread.
class BlendSearch {
  public:
    /// Samples along the longest side of the box, where they do not cost too much.
    static constexpr std::uint32_t usual_samples = 512;
    /// At least as many are enough for a judgement.
    static constexpr std::uint32_t enough_samples = 256;

    /// `fields` are of x, y, z; both have clause tapes.
    BlendSearch(ClauseTape change, ClauseTape joint, MeasuredBox box);

    /// `with_parts` false: it ends at the first sample that the blend changes.
    BlendMap run(bool with_parts, const Job& job);
    /// True when a point of the joint may lie within a sample's distance of a sample of the part.
    bool touches_joint(const std::vector<SampleIndex>& part);
    /// The sample of the part where the change is largest, of some thousands of them.
    Vec3 most_changed(const std::vector<SampleIndex>& part);

  private:
    using Index = std::array<std::uint32_t, 3>;
    struct OpenCell {
        Index at{};
        std::shared_ptr<const ClauseTape> tape;
    };
    double cell_size(int level) const;
    std::uint32_t samples_a_side(int level) const;
    void set_lane(BoxLanes& boxes, std::size_t lane, const std::array<double, 3>& low, double size) const;
    std::vector<OpenCell> judged(const std::vector<OpenCell>& cells, int level);
    std::vector<OpenCell> children(const std::vector<OpenCell>& cells, int level) const;
    static double work_of(const std::vector<OpenCell>& cells);
    BlendMap look_closer(std::vector<OpenCell> cells, int level, const Job& job);
    Vec3 place(const SampleIndex& sample) const;
    bool is_changed_at_middle(const std::vector<OpenCell>& cells, int level);
    std::vector<SampleIndex> changes_in(const std::vector<OpenCell>& cells, int level, bool all);

    std::shared_ptr<const ClauseTape> change_;
    ClauseTape joint_;
    MeasuredBox box_;
    Index cells_{1, 1, 1};    ///< of the smallest size, along each axis
    double sample_size_ = 0;  ///< distance of samples that are next to each other
    Pruner pruner_;
    CutResult cut_;
    BatchVm<double> vm_;
};

}  // namespace frep::measuring
