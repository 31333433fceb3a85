// One picture of a scene: rays in tiles, samples, edges that need more samples, pixels. Tested by
// tests/unit/trace/solid_picture_test.cpp.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "frep/eval/field_pool.h"
#include "frep/trace/first_hit.h"
#include "frep/trace/shading.h"
#include "frep/trace/solid_picture.h"

namespace frep::tracing {

/// What one ray brings: light as displayed (0..1, linear, multiplied by alpha), and what it met.
struct Sample {
    Rgb light;
    double alpha = 1;
    float depth = 0;               ///< along the ray; only of hits
    float nx = 0, ny = 0, nz = 0;  ///< normal of a hit
    std::uint8_t kind = 0;         ///< 0 nothing, 1 surface, 2 section
};

class Painter {
  public:
    /// `how`: see FirstHit.
    Painter(const DistanceGrid& grid, FieldPool& fields, const SceneOptions& scene,
            const PictureOptions& options, HitSearch how);

    /// The picture. Errors: cancelled.
    Result<Image> paint(const Job& job);

  private:
    struct Worker;
    /// Samples at points of the picture: x and y in pixels.
    void sample(Worker& worker, std::span<const Vec2> places, std::span<Sample> samples) const;
    void find_normals(Worker& worker) const;
    void find_colors(Worker& worker) const;
    Rgb hit_light(const Worker& worker, std::size_t i, const Ray& ray, const Hit& hit, Sample& sample) const;
    std::optional<Vec3> on_ground(const Ray& ray) const;
    double ground_light(Vec2 place) const;
    void backdrop(const Ray& ray, Vec2 place, Sample& sample) const;
    Rgb backdrop_light(Vec2 place) const;
    bool is_edge(const Sample& a, const Sample& b) const;
    std::vector<std::uint32_t> edges() const;
    void smooth_edges(const Job& job);
    Image developed() const;

    const DistanceGrid& grid_;
    FieldPool& fields_;
    HitSearch how_;
    const PictureOptions& options_;
    const NamedMaterial& material_;
    NamedMaterial section_material_;
    Camera camera_;
    Studio studio_;
    Stage stage_;
    Shader shader_;
    Rgb section_base_;
    int section_side_ = 0;  ///< as Hit::cut_by
    std::vector<Sample> samples_;
    /// Light on the table at corners of squares of pixels; negative: not known yet.
    mutable std::vector<std::atomic<float>> ground_;
};

}  // namespace frep::tracing
