// The light of a point of a surface: diffuse light from the dome through cones traced in the distance grid
// (ambient occlusion), diffuse light from the softboxes with soft shadows, the reflection of the studio and
// of the object itself, under a clear coat or not. Sources: sphere tracing, Hart 1996, "Sphere tracing: a
// geometric method for the antialiased ray tracing of implicit surfaces"; shadows from the least ratio of
// distance to way along the ray, Quilez 2010, "Soft shadows in raymarched SDFs"; Fresnel, Schlick 1994;
// microfacets, Walter and others 2007, "Microfacet models for refraction through rough surfaces" (GGX), their
// integral over the studio after Lazarov 2013, "Getting more physical in Call of Duty: Black Ops II".
// Tested by tests/unit/trace/shading_test.cpp.
#pragma once

#include <vector>

#include "frep/trace/distance_grid.h"
#include "frep/trace/environment.h"
#include "frep/trace/materials.h"

namespace frep::tracing {

/// The table that the object stands on: the plane z = `height`, if there is one.
struct Ground {
    bool is_there = false;
    double height = 0;
};

/// What all points of a picture share.
struct Stage {
    const DistanceGrid& grid;
    const Studio& studio;
    const NamedMaterial& material;
    Rgb base;     ///< of the material, linear: what reflections show
    double size;  ///< the diagonal of the object's box
    Ground ground;
    int cones;  ///< for the dome's light, in all directions
};

class Shader {
  public:
    explicit Shader(const Stage& stage);

    /// The light that a surface at p, with unit normal n, sends towards the unit vector `to_eye`.
    Rgb shade(const Surface& surface, Vec3 p, Vec3 n, Vec3 to_eye) const;

    /// The share of the studio's light that reaches the table at p, 0..1.
    double ground_light(Vec3 p) const;
    /// The reflection in the table at p, seen along `direction`: its color and strength 0..1.
    struct Reflection {
        Rgb color;
        double strength = 0;
    };
    Reflection ground_reflection(Vec3 p, Vec3 direction) const;

  private:
    double shadow(Vec3 p, Vec3 direction, double spread) const;
    double cone(Vec3 p, Vec3 direction, double cosine) const;
    Rgb dome_light(Vec3 p, Vec3 n) const;
    Rgb lamp_light(Vec3 p, Vec3 n) const;
    Rgb reflected(Vec3 p, Vec3 n, Vec3 direction, double roughness) const;
    bool meets_object(Vec3 p, Vec3 direction, double& t) const;
    Rgb plain(Vec3 p, Vec3 n, Vec3 to_eye) const;

    const Stage& stage_;
    std::vector<Vec3> directions_;
    double reach_;   ///< how far shadows are looked for
    double offset_;  ///< points are lifted off the surface by this
};

}  // namespace frep::tracing
