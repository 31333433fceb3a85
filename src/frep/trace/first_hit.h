// The first point of a solid along each of a batch of rays. A ray walks through the cells of a DistanceGrid
// and skips those that surely hold nothing; in the others F is sampled about a cell apart, a change of sign
// is narrowed to a root, and intervals prove that nothing lies in front of it, subdividing where they cannot
// (Duff 1992). Just in front of a root (a cell and a half) five samples of F that rise evenly stand for the
// proof: anything thin would lift one of them. What is closer together along the ray than `leaf` is not told
// apart. Rays move through the steps together, so that the engine sees long batches.
// Tested by tests/unit/trace/first_hit_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "frep/eval/sampled_field.h"
#include "frep/trace/camera.h"
#include "frep/trace/distance_grid.h"

namespace frep::tracing {

/// Where the ray meets the solid: its surface, or a side of the clip box: 1 + number of -x +x -y +y -z +z.
struct Hit {
    static constexpr double never = std::numeric_limits<double>::infinity();
    double t = never;         ///< along the ray, at the inside end of the root's bracket
    std::uint8_t cut_by = 0;  ///< 0: the surface F = 0

    bool is_hit() const { return t < never; }
};

class FirstHit {
  public:
    /// `leaf`: lengths below that are not told apart in front of a root, in model units. Each `group` of rays
    /// are neighbours, parts of it (quarters, quarters of these) near ones; they share proofs.
    /// `finest`: what is thinner than that share of a cell may be missed;
    /// 0: no proofs, samples half a cell apart only.
    FirstHit(const DistanceGrid& grid, SampledField& field, double leaf, std::size_t group = 1,
             double finest = 1.0 / 16);
    ~FirstHit();

    /// hits[i] for rays[i].
    void trace(std::span<const Ray> rays, std::span<Hit> hits);

  private:
    struct State;
    struct Segment;
    struct Packet;
    void begin(std::span<const Ray> rays);
    void next_chunks(std::span<Hit> hits);
    void sample_chunks(std::span<Hit> hits);
    void find_roots(const std::vector<std::size_t>& which);
    void take_profiles();
    double proof_end(const State& state) const;
    void prove_packets();
    std::vector<Packet> first_packets();
    Box3 box_of_packet(const Packet& packet) const;
    void divide(const Packet& packet, std::vector<Packet>& out);
    void verify();
    void evaluate();

    const DistanceGrid& grid_;
    SampledField& field_;
    double leaf_;
    std::size_t group_;
    double finest_;
    std::span<const Ray> rays_;
    std::vector<State> states_;
    std::vector<std::size_t> active_, rooted_;
    std::vector<double> x_, y_, z_, f_;
    std::vector<Box3> boxes_;
    std::vector<SignRange> ranges_;
};

}  // namespace frep::tracing
