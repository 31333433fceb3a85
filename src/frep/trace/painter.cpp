// Implementation of painter.h.
#include "frep/trace/painter.h"

#include <algorithm>
#include <array>

#include "frep/base/parallel.h"
#include "frep/math/functions.h"

namespace frep::tracing {

namespace {

constexpr int tile = 32;            ///< pixels a side
constexpr int ground_square = 2;    ///< pixels
constexpr double thinnest = 0.125;  ///< pixels: a ray misses less of the solid than that
constexpr std::size_t edge_pixels_a_task = 64;

/// Places within a pixel for edges: eight rooks, none in the row or column of another.
constexpr std::array<Vec2, 8> rooks{Vec2{0.0625, 0.5625}, {0.1875, 0.1875}, {0.3125, 0.8125},
                                    {0.4375, 0.4375},     {0.5625, 0.0625}, {0.6875, 0.6875},
                                    {0.8125, 0.3125},     {0.9375, 0.9375}};

/// The film: straight up to a knee, then bending towards white.
double film(double x) {
    constexpr double knee = 0.62;
    if (x <= knee) return std::max(x, 0.0);
    return knee + (1 - knee) * (1 - math::exp(-(x - knee) / (1 - knee)));
}
Rgb film(Rgb c) { return {film(c.r), film(c.g), film(c.b)}; }

/// Thresholds of an 8 by 8 ordered dither (Bayer 1973), -0.5..0.5.
double dither(int x, int y) {
    int value = 0;
    for (int bit = 0; bit < 3; ++bit) {
        const int a = x >> bit & 1, b = y >> bit & 1;
        value |= ((a ^ b) << 1 | b) << (2 * (2 - bit));
    }
    return (value + 0.5) / 64 - 0.5;
}

/// The bits of a number below 2^16 with a gap of one between them.
std::uint32_t spread_bits(std::uint32_t v) {
    v = (v | v << 8) & 0x00ff00ffU;
    v = (v | v << 4) & 0x0f0f0f0fU;
    v = (v | v << 2) & 0x33333333U;
    return (v | v << 1) & 0x55555555U;
}

int cones_of(PictureQuality quality) {
    switch (quality) {
        case PictureQuality::draft:
            return 16;
        case PictureQuality::normal:
            return 32;
        case PictureQuality::high:
            break;
    }
    return 64;
}

const NamedMaterial& material_of(const PictureOptions& options) {
    return options.material ? *options.material : materials().front();
}

/// The points that the camera must see; all round: circles through them.
std::vector<Vec3> framed_points(const DistanceGrid& grid, const PictureOptions& options) {
    std::vector<Vec3> points;
    if (!options.stage) points = grid.surface_points();
    if (points.empty()) {
        const Box3 box = options.stage.value_or(grid.clip());
        for (unsigned c = 0; c < 8; ++c)
            points.push_back({c & 1 ? box.min.x : box.max.x, c & 2 ? box.min.y : box.max.y,
                              c & 4 ? box.min.z : box.max.z});
    }
    if (!options.framed_all_round) return points;
    Vec3 lo = points[0], hi = points[0];
    for (const Vec3& p : points) {
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
    }
    const Vec3 middle = (lo + hi) * 0.5;
    double radius = 0;
    for (const Vec3& p : points) radius = std::max(radius, length({p.x - middle.x, p.y - middle.y, 0}));
    points.clear();
    for (const double z : {lo.z, hi.z})
        for (int n = 0; n < 64; ++n) {
            const double angle = 6.28318530717958647692 * n / 64;
            points.push_back({middle.x + radius * math::cos(angle), middle.y + radius * math::sin(angle), z});
        }
    return points;
}

}  // namespace

struct Painter::Worker {
    Worker(const DistanceGrid& grid, FieldPool& fields, double pixel, HitSearch how)
        : field(fields.borrow()), first_hit(grid, *field, pixel, thinnest * pixel, how) {}
    FieldPool::Lease field;
    FirstHit first_hit;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Vec2> places;
    std::vector<Sample> samples;
    RayColumns points;  ///< of the hits
    std::array<std::vector<double>, 3> colors;
    std::vector<Vec3> normals;
    std::vector<Rgb> bases;
};

Painter::Painter(const DistanceGrid& grid, FieldPool& fields, const SceneOptions& scene,
                 const PictureOptions& options, HitSearch how)
    : grid_(grid),
      fields_(fields),
      how_(how),
      options_(options),
      material_(material_of(options)),
      section_material_{"section", "", {options.section_color, 0, 0.8, 0}},
      camera_(options.view, framed_points(grid, options), options.width, options.height),
      studio_(options.view.azimuth),
      stage_{grid,
             studio_,
             material_,
             linear(options.color.value_or(material_.look.base)),
             length({grid.cells()[0] * 1.0, grid.cells()[1] * 1.0, grid.cells()[2] * 1.0}) * grid.step(),
             {options.ground && (options.stage || grid.has_solid()),
              options.stage ? options.stage->min.z : grid.lowest()},
             cones_of(scene.quality)},
      shader_(stage_),
      section_base_(linear(options.section_color)) {
    if (scene.section) section_side_ = 1 + 2 * scene.section->axis + (scene.section->keeps_less ? 1 : 0);
}

Result<Image> Painter::paint(const Job& job) {
    const auto width = static_cast<std::size_t>(options_.width);
    samples_.resize(width * static_cast<std::size_t>(options_.height));
    const auto squares = [](int pixels) { return static_cast<std::size_t>(pixels / ground_square + 2); };
    ground_ = std::vector<std::atomic<float>>(squares(options_.width) * squares(options_.height));
    for (std::atomic<float>& light : ground_) light.store(-1, std::memory_order_relaxed);
    const int across = (options_.width + tile - 1) / tile, down = (options_.height + tile - 1) / tile;
    parallel_for(job, static_cast<std::size_t>(across * down), [&](std::size_t task) {
        const int x0 = static_cast<int>(task) % across * tile, y0 = static_cast<int>(task) / across * tile;
        Worker worker(grid_, fields_, camera_.pixel_size(), how_);
        // In Morton order: any quarter of the tile is a square of neighbours.
        for (unsigned n = 0; n < unsigned{tile * tile}; ++n) {
            unsigned x = 0, y = 0;
            for (unsigned bit = 0; bit < 5; ++bit) {
                x |= (n >> (2 * bit) & 1U) << bit;
                y |= (n >> (2 * bit + 1) & 1U) << bit;
            }
            worker.places.push_back({x0 + static_cast<int>(x) + 0.5, y0 + static_cast<int>(y) + 0.5});
        }
        worker.samples.resize(worker.places.size());
        sample(worker, worker.places, worker.samples);
        for (std::size_t n = 0; n < worker.places.size(); ++n) {
            const auto x = static_cast<std::size_t>(worker.places[n].x),
                       y = static_cast<std::size_t>(worker.places[n].y);
            if (x < width && y < static_cast<std::size_t>(options_.height))
                samples_[y * width + x] = worker.samples[n];
        }
    });
    if (!job.cancelled()) smooth_edges(job);
    if (job.cancelled()) return Error{ErrorKind::cancelled, "the picture was cancelled"};
    return developed();
}

void Painter::sample(Worker& w, std::span<const Vec2> places, std::span<Sample> samples) const {
    w.rays.clear();
    for (const Vec2& place : places) w.rays.push_back(camera_.ray(place.x, place.y));
    w.hits.resize(places.size());
    w.first_hit.trace(w.rays, w.hits);
    find_normals(w);
    find_colors(w);
    for (std::size_t i = 0; i < places.size(); ++i) {
        samples[i] = {};
        if (w.hits[i].is_hit())
            samples[i].light = film(hit_light(w, i, w.rays[i], w.hits[i], samples[i]));
        else
            backdrop(w.rays[i], places[i], samples[i]);
    }
}

/// Outward unit normals of the hits: from the gradient; where that is nothing, from the distances.
void Painter::find_normals(Worker& w) const {
    w.normals.assign(w.hits.size(), {});
    for (std::size_t i = 0; i < w.hits.size(); ++i) {
        const Hit& hit = w.hits[i];
        if (!hit.is_hit()) continue;
        Vec3 normal = -hit.gradient;
        const double size = length(normal);
        normal = size > 0 && size < 1e300 ? normal / size : grid_.direction(at(w.rays[i], hit.t));
        if (hit.cut_by > 0) {
            const int side = hit.cut_by - 1;
            const double s = side % 2 == 0 ? -1 : 1;
            normal = {side / 2 == 0 ? s : 0, side / 2 == 1 ? s : 0, side / 2 == 2 ? s : 0};
        }
        // A crease that is seen from behind is bent into view.
        const double away = dot(normal, w.rays[i].direction);
        if (away > 0) normal = normal - w.rays[i].direction * (away + 1e-3);
        const double bent = length(normal);
        w.normals[i] = bent > 0 ? normal / bent : -w.rays[i].direction;
    }
}

/// The base colors of the hits.
void Painter::find_colors(Worker& w) const {
    w.bases.assign(w.hits.size(), stage_.base);
    if (!material_.uses_attributes || w.field->attribute_count() < 3) return;
    w.points.clear();
    for (std::size_t i = 0; i < w.hits.size(); ++i)
        if (w.hits[i].is_hit()) w.points.add(at(w.rays[i], w.hits[i].t));
    if (w.points.size() == 0) return;
    std::array<std::span<double>, 3> out;
    for (std::size_t k = 0; k < 3; ++k) {
        w.colors[k].resize(w.points.size());
        out[k] = w.colors[k];
    }
    w.field->attributes(w.points.points(), out);
    std::size_t n = 0;
    for (std::size_t i = 0; i < w.hits.size(); ++i) {
        if (!w.hits[i].is_hit()) continue;
        w.bases[i] = linear({w.colors[0][n], w.colors[1][n], w.colors[2][n]});
        ++n;
    }
}

Rgb Painter::hit_light(const Worker& w, std::size_t i, const Ray& ray, const Hit& hit, Sample& sample) const {
    const Vec3 p = ray.origin + ray.direction * hit.t;
    const Vec3 n = w.normals[i];
    const bool is_section = section_side_ > 0 && hit.cut_by == section_side_;
    sample.depth = static_cast<float>(hit.t);
    sample.nx = static_cast<float>(n.x), sample.ny = static_cast<float>(n.y),
    sample.nz = static_cast<float>(n.z);
    sample.kind = is_section ? 2 : 1;
    const Surface surface = is_section ? surface_at(section_material_, section_base_, p, stage_.size)
                                       : surface_at(material_, w.bases[i], p, stage_.size);
    return shader_.shade(surface, p, n, -ray.direction);
}

/// The backdrop's light, 0..1: a paper sweep, brighter around the object.
Rgb Painter::backdrop_light(Vec2 place) const {
    if (options_.backdrop == Backdrop::plain) return linear(options_.backdrop_color);
    const double u = place.x / options_.width - 0.5, v = place.y / options_.height;
    const Rgb top{0.62, 0.605, 0.585}, middle{0.80, 0.79, 0.77}, bottom{0.70, 0.69, 0.675};
    const Rgb paper = v < 0.55 ? mix(top, middle, smooth_step(-0.1, 0.55, v))
                               : mix(middle, bottom, smooth_step(0.55, 1.15, v));
    const double corner = u * u * 1.1 + (v - 0.52) * (v - 0.52) * 0.9;
    return paper * (1.05 - 0.42 * corner);
}

/// Where a ray meets the table; nothing where it does not, or far from the object.
std::optional<Vec3> Painter::on_ground(const Ray& ray) const {
    if (!stage_.ground.is_there || ray.direction.z > -1e-6 || ray.origin.z <= stage_.ground.height) return {};
    const Vec3 p = at(ray, (stage_.ground.height - ray.origin.z) / ray.direction.z);
    if (grid_.distance(p) > 3 * stage_.size) return {};
    return p;
}

/// The light that the object leaves on the table at a point of the picture. It changes slowly: it is found at
/// the corners of squares of two pixels, each when it is first needed, and interpolated.
double Painter::ground_light(Vec2 place) const {
    const auto across = static_cast<std::size_t>(options_.width / ground_square + 2);
    // tiles reach beyond the picture
    const double u = std::min(place.x, options_.width * 1.0) / ground_square,
                 v = std::min(place.y, options_.height * 1.0) / ground_square;
    const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
    std::array<double, 4> corner{};
    for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t x = i + (c & 1), y = j + (c >> 1);
        std::atomic<float>& light = ground_[y * across + x];
        float known = light.load(std::memory_order_relaxed);
        if (known < 0) {
            const auto p = on_ground(
                camera_.ray(static_cast<double>(x) * ground_square, static_cast<double>(y) * ground_square));
            known = p ? static_cast<float>(shader_.ground_light(*p)) : 1.0F;
            light.store(known, std::memory_order_relaxed);  // the same from every thread
        }
        corner[c] = double{known};
    }
    const double a = u - static_cast<double>(i), b = v - static_cast<double>(j);
    return mix(mix(corner[0], corner[1], a), mix(corner[2], corner[3], a), b);
}

void Painter::backdrop(const Ray& ray, Vec2 place, Sample& sample) const {
    const bool transparent = options_.backdrop == Backdrop::transparent;
    sample.light = transparent ? Rgb{} : backdrop_light(place);
    sample.alpha = transparent ? 0 : 1;
    const auto p = on_ground(ray);
    if (!p) return;
    const double light = ground_light(place);
    if (transparent) {
        sample.alpha = 1 - light;
        return;
    }
    sample.light = sample.light * light;
    const Shader::Reflection mirror = shader_.ground_reflection(*p, ray.direction);
    if (mirror.strength > 0) sample.light = mix(sample.light, film(mirror.color), mirror.strength);
}

bool Painter::is_edge(const Sample& a, const Sample& b) const {
    if (a.kind != b.kind) return true;
    const Rgb d = a.light - b.light;
    const double change = std::max({__builtin_fabs(d.r), __builtin_fabs(d.g), __builtin_fabs(d.b)});
    const double bright = std::max({a.light.r, a.light.g, a.light.b, b.light.r, b.light.g, b.light.b});
    if (change > 0.02 + 0.07 * bright) return true;
    if (a.kind == 0) return false;
    if (a.nx * b.nx + a.ny * b.ny + a.nz * b.nz < 0.85F) return true;
    return __builtin_fabs(a.depth - b.depth) > 20 * camera_.pixel_size();
}

/// Pixels that differ from a neighbour, in Morton order of their places.
std::vector<std::uint32_t> Painter::edges() const {
    const auto width = static_cast<std::size_t>(options_.width),
               height = static_cast<std::size_t>(options_.height);
    std::vector<std::uint8_t> marked(samples_.size(), 0);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t p = y * width + x;
            if (x + 1 < width && is_edge(samples_[p], samples_[p + 1])) marked[p] = marked[p + 1] = 1;
            if (y + 1 < height && is_edge(samples_[p], samples_[p + width]))
                marked[p] = marked[p + width] = 1;
        }
    std::vector<std::uint32_t> list;
    for (std::size_t p = 0; p < marked.size(); ++p)
        if (marked[p]) list.push_back(static_cast<std::uint32_t>(p));
    const auto code = [&](std::uint32_t p) {
        const auto w = static_cast<std::uint32_t>(width);
        return spread_bits(p % w) | spread_bits(p / w) << 1;
    };
    std::sort(list.begin(), list.end(), [&](std::uint32_t a, std::uint32_t b) { return code(a) < code(b); });
    return list;
}

/// More samples where neighbours differ.
void Painter::smooth_edges(const Job& job) {
    const std::vector<std::uint32_t> list = edges();
    const std::size_t tasks = (list.size() + edge_pixels_a_task - 1) / edge_pixels_a_task;
    parallel_for(job, tasks, [&](std::size_t task) {
        const std::size_t first = task * edge_pixels_a_task;
        const std::size_t last = std::min(first + edge_pixels_a_task, list.size());
        Worker worker(grid_, fields_, camera_.pixel_size(), how_);
        const auto width = static_cast<std::uint32_t>(options_.width);
        for (std::size_t e = first; e < last; ++e)
            for (const Vec2& rook : rooks)
                worker.places.push_back({list[e] % width + rook.x, list[e] / width + rook.y});
        worker.samples.resize(worker.places.size());
        sample(worker, worker.places, worker.samples);
        for (std::size_t e = first; e < last; ++e) {
            Sample& pixel = samples_[list[e]];
            pixel.light = {};
            pixel.alpha = 0;
            for (std::size_t r = 0; r < rooks.size(); ++r) {
                const Sample& s = worker.samples[(e - first) * rooks.size() + r];
                pixel.light += s.light * (1.0 / rooks.size());
                pixel.alpha += s.alpha / rooks.size();
            }
        }
    });
}

Image Painter::developed() const {
    Image image = Image::sized(options_.width, options_.height);
    std::size_t n = 0;
    for (int y = 0; y < options_.height; ++y)
        for (int x = 0; x < options_.width; ++x, ++n) {
            const Sample& s = samples_[n];
            const double scale = s.alpha > 0 ? 1 / s.alpha : 0;
            const Color c = srgb_from_linear({s.light.r * scale, s.light.g * scale, s.light.b * scale});
            const double d = options_.backdrop == Backdrop::studio ? dither(x, y) / 255 : 0;
            image.pixels[4 * n] = color_byte(c.r + d);
            image.pixels[4 * n + 1] = color_byte(c.g + d);
            image.pixels[4 * n + 2] = color_byte(c.b + d);
            image.pixels[4 * n + 3] = color_byte(s.alpha);
        }
    return image;
}

}  // namespace frep::tracing
