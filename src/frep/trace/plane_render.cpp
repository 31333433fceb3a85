// Implementation of plane_render.h. A tile of 32 x 32 pixels is subdivided by intervals down to blocks of
// 4 x 4; undecided blocks are sampled 2 x 2 times a pixel with a border of one sample around; where these
// differ around a pixel, 64 points of a rank-1 lattice (generator 19, the most even of its size) measure how
// much of the pixel is covered.
#include "frep/trace/plane_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "frep/base/parallel.h"
#include "frep/eval/field_pool.h"
#include "frep/trace/plane_picture.h"

namespace frep {

namespace {

constexpr int tile_side = 32, block_side = 4;
constexpr int lattice_size = 64, lattice_generator = 19;
constexpr int block_samples = 2 * block_side + 2;  ///< a side, with the border

/// What is known of a pixel: how many of the 64 points are inside, and which of the quarters' middles are.
struct Pixel {
    int covered = 0;
    unsigned quarters = 0;  ///< bit 2 * row + column
    Vec2 inside{0.5, 0.5};  ///< some inside point of a covered pixel, within it
    Color color;            ///< linear
};

struct Block {
    int x, y, side;  ///< pixels of the picture; may stick out of it
};

/// Point k of the lattice in the unit square.
Vec2 lattice_point(int k) {
    return {(k + 0.5) / lattice_size, (k * lattice_generator % lattice_size + 0.5) / lattice_size};
}

Vec2 quarter_middle(int q) { return {0.25 + 0.5 * (q % 2), 0.25 + 0.5 * (q / 2)}; }

/// Works on one tile at a time.
class TilePainter {
  public:
    TilePainter(SampledField& field, const PlaneRenderOptions& options, const Window& window)
        : field_(field), options_(options), window_(window) {}

    /// Fills the pixels of the tile at (x, y), row after row of `pixels`, of which each has `stride`.
    void paint(int x, int y, std::vector<Pixel>& pixels) {
        pixels_ = &pixels;
        for (const Block& block : undecided({x, y, tile_side})) sample_block(block);
        if (options_.attribute_colors) color_tile(x, y);
    }

    std::uint64_t sampled = 0, undefined = 0;

  private:
    Pixel& pixel(int x, int y) {
        return (*pixels_)[static_cast<std::size_t>(y) * static_cast<std::size_t>(window_.columns) +
                          static_cast<std::size_t>(x)];
    }
    bool in_picture(int x, int y) const {
        return x >= 0 && y >= 0 && x < window_.columns && y < window_.rows;
    }

    void add_point(double x, double y) {
        const Vec3 p = options_.plane.point({window_.x(x), window_.y(y)});
        x_.push_back(p.x);
        y_.push_back(p.y);
        z_.push_back(p.z);
    }
    void clear_points() {
        x_.clear();
        y_.clear();
        z_.clear();
    }
    /// F at the collected points.
    const std::vector<double>& values() {
        values_.resize(x_.size());
        field_.values({x_, y_, z_}, values_);
        sampled += x_.size();
        return values_;
    }

    Box3 box_of(const Block& b) const {
        const Vec2 low{window_.x(b.x), window_.y(std::min(b.y + b.side, window_.rows))};
        const Vec2 high{window_.x(std::min(b.x + b.side, window_.columns)), window_.y(b.y)};
        return {options_.plane.point(low), options_.plane.point(high)};
    }

    void fill(const Block& b) {
        for (int y = b.y; y < std::min(b.y + b.side, window_.rows); ++y) {
            for (int x = b.x; x < std::min(b.x + b.side, window_.columns); ++x) {
                pixel(x, y).covered = lattice_size;
                pixel(x, y).quarters = 15;
            }
        }
    }

    /// The blocks of the smallest side that intervals leave undecided; others are filled or left empty.
    std::vector<Block> undecided(const Block& tile) {
        std::vector<Block> open{tile}, next;
        std::vector<Box3> boxes;
        std::vector<SignRange> ranges;
        for (int side = tile_side;; side /= 2) {
            if (options_.prune) {
                boxes.clear();
                for (const Block& b : open) boxes.push_back(box_of(b));
                ranges.resize(open.size());
                field_.ranges(boxes, ranges);
            } else {
                ranges.assign(open.size(), {});
            }
            next.clear();
            for (std::size_t i = 0; i < open.size(); ++i) {
                const SignRange& r = ranges[i];
                if (!r.can_be_inside) continue;
                if (!r.can_be_outside && !r.can_be_undefined) {
                    fill(open[i]);
                } else if (side == block_side) {
                    next.push_back(open[i]);
                } else {
                    split(open[i], next);
                }
            }
            open.swap(next);
            if (side == block_side || open.empty()) return open;
        }
    }

    void split(const Block& b, std::vector<Block>& out) const {
        const int half = b.side / 2;
        for (int k = 0; k < 4; ++k) {
            const Block part{b.x + k % 2 * half, b.y + k / 2 * half, half};
            if (in_picture(part.x, part.y)) out.push_back(part);
        }
    }

    void sample_block(const Block& b) {
        clear_points();
        for (int j = 0; j < block_samples; ++j) {
            for (int i = 0; i < block_samples; ++i) add_point(b.x + (i - 0.5) / 2, b.y + (j - 0.5) / 2);
        }
        const std::vector<double>& v = values();
        std::array<bool, block_samples * block_samples> inside{};
        for (std::size_t k = 0; k < inside.size(); ++k) {
            inside[k] = v[k] >= 0;
            undefined += v[k] != v[k] ? 1 : 0;
        }
        for (int y = 0; y < b.side; ++y) {
            for (int x = 0; x < b.side; ++x) {
                if (!in_picture(b.x + x, b.y + y)) continue;
                Pixel& p = pixel(b.x + x, b.y + y);
                int count = 0;  // of the 4 x 4 samples around the pixel's middle
                for (int k = 0; k < 16; ++k) {
                    const bool in =
                        inside[static_cast<std::size_t>((2 * y + k / 4) * block_samples + 2 * x + k % 4)];
                    count += in ? 1 : 0;
                    const int column = k % 4 - 1, row = k / 4 - 1;
                    if (in && column >= 0 && column < 2 && row >= 0 && row < 2)
                        p.quarters |= 1u << (2 * row + column);
                }
                if (count == 16) p.covered = lattice_size;
                if (count > 0 && count < 16) crossed_.push_back({b.x + x, b.y + y, 1});
            }
        }
        measure_crossed();
    }

    /// Counts the lattice points that are inside, for each of the crossed pixels.
    void measure_crossed() {
        clear_points();
        for (const Block& b : crossed_) {
            for (int k = 0; k < lattice_size; ++k) {
                const Vec2 p = lattice_point(k);
                add_point(b.x + p.x, b.y + p.y);
            }
        }
        const std::vector<double>& v = values();
        for (std::size_t i = 0; i < crossed_.size(); ++i) {
            Pixel& p = pixel(crossed_[i].x, crossed_[i].y);
            double nearest = 2;
            for (int k = 0; k < lattice_size; ++k) {
                if (!(v[i * lattice_size + static_cast<std::size_t>(k)] >= 0)) continue;
                ++p.covered;
                const Vec2 at = lattice_point(k), off = at - Vec2{0.5, 0.5};
                const double distance = off.x * off.x + off.y * off.y;
                if (!(distance < nearest)) continue;
                nearest = distance;
                p.inside = at;
            }
        }
        crossed_.clear();
    }

    /// Colors of the tile's covered pixels: the mean over the quarters' middles that are inside, or the color
    /// at some inside point.
    void color_tile(int tile_x, int tile_y) {
        clear_points();
        std::vector<std::pair<Pixel*, int>> parts;  // pixel, number of its points
        for (int y = tile_y; y < std::min(tile_y + tile_side, window_.rows); ++y) {
            for (int x = tile_x; x < std::min(tile_x + tile_side, window_.columns); ++x) {
                Pixel& p = pixel(x, y);
                if (p.covered == 0) continue;
                const std::size_t before = x_.size();
                for (int q = 0; q < 4; ++q) {
                    const Vec2 at = quarter_middle(q);
                    if ((p.quarters >> q) & 1u) add_point(x + at.x, y + at.y);
                }
                if (p.quarters == 0) add_point(x + p.inside.x, y + p.inside.y);
                parts.emplace_back(&p, static_cast<int>(x_.size() - before));
            }
        }
        if (parts.empty()) return;
        for (auto& column : colors_) column.assign(x_.size(), 0);
        const std::array<std::span<double>, 3> columns{colors_[0], colors_[1], colors_[2]};
        field_.attributes({x_, y_, z_}, columns);
        std::size_t at = 0;
        for (const auto& [p, count] : parts) {
            p->color = {};
            for (int k = 0; k < count; ++k, ++at) {
                const Color c = linear_color({colors_[0][at], colors_[1][at], colors_[2][at]});
                p->color = {p->color.r + c.r / count, p->color.g + c.g / count, p->color.b + c.b / count};
            }
        }
    }

    /// An undefined component makes the color that of the shape.
    Color linear_color(const Color& c) const {
        const bool defined = c.r == c.r && c.g == c.g && c.b == c.b;
        return linear_from_srgb(defined ? c : options_.color);
    }

    SampledField& field_;
    const PlaneRenderOptions& options_;
    const Window& window_;
    std::vector<Pixel>* pixels_ = nullptr;
    std::vector<double> x_, y_, z_, values_;
    std::array<std::vector<double>, 3> colors_;
    std::vector<Block> crossed_;
};

Status check_options(const SampledField& field, const PlaneRenderOptions& o) {
    const auto invalid = [](std::string message) {
        return Status(Error{ErrorKind::invalid_argument, std::move(message)});
    };
    const auto within = [](int v) { return v >= 1 && v <= greatest_picture_side; };
    if (!within(o.width) || !within(o.height))
        return invalid(fmt::format("a picture of {} x {} pixels is out of range: sides are 1 to {}", o.width,
                                   o.height, greatest_picture_side));
    if (!(o.margin >= 0 && o.margin < 0.5)) return invalid("the margin is not 0 to below 0.5");
    if (o.attribute_colors && field.attribute_count() < 3)
        return invalid(
            fmt::format("colors need three attributes, the model has {}", field.attribute_count()));
    return {};
}

/// The pixels over the background, as linear light.
Image compose(const std::vector<Pixel>& pixels, const PlaneRenderOptions& options) {
    Image image = Image::sized(options.width, options.height);
    const Color base = linear_from_srgb(options.color);
    const Color under = linear_from_srgb(options.background.value_or(Color{}));
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const double share = static_cast<double>(pixels[i].covered) / lattice_size;
        const Color over = options.attribute_colors ? pixels[i].color : base;
        Color mixed = over;
        if (options.background)
            mixed = {under.r + (over.r - under.r) * share, under.g + (over.g - under.g) * share,
                     under.b + (over.b - under.b) * share};
        const Color encoded = share > 0 || options.background ? srgb_from_linear(mixed) : Color{};
        std::uint8_t* out = &image.pixels[4 * i];
        out[0] = color_byte(encoded.r);
        out[1] = color_byte(encoded.g);
        out[2] = color_byte(encoded.b);
        out[3] = options.background ? std::uint8_t{255} : color_byte(share);
    }
    return image;
}

}  // namespace

Result<PlaneRender> render_plane(const SampledField& field, const PlaneRenderOptions& options,
                                 const Job& job) {
    if (const Status status = check_options(field, options); !status) return status.error();
    const auto window = Window::around(options.part, options.width, options.height, options.margin);
    if (!window) return window.error();
    PlaneRender out;
    out.window = *window;
    std::vector<Pixel> pixels(static_cast<std::size_t>(options.width) *
                              static_cast<std::size_t>(options.height));
    const int tiles_across = (options.width + tile_side - 1) / tile_side;
    const int tiles_down = (options.height + tile_side - 1) / tile_side;
    std::vector<std::array<std::uint64_t, 2>> counts(static_cast<std::size_t>(tiles_across) *
                                                     static_cast<std::size_t>(tiles_down));
    FieldPool fields(field);
    parallel_for(job, counts.size(), [&](std::size_t i) {
        const FieldPool::Lease borrowed = fields.borrow();
        TilePainter painter(*borrowed, options, *window);
        const int tile = static_cast<int>(i);
        painter.paint(tile % tiles_across * tile_side, tile / tiles_across * tile_side, pixels);
        counts[i] = {painter.sampled, painter.undefined};
    });
    if (job.cancelled()) return Error{ErrorKind::cancelled, "the picture was cancelled"};
    std::uint64_t covered = 0;
    for (const Pixel& p : pixels) covered += static_cast<std::uint64_t>(p.covered);
    for (const auto& [sampled, undefined] : counts) {
        out.sampled += sampled;
        out.undefined += undefined;
    }
    out.area = static_cast<double>(covered) / lattice_size * window->step * window->step;
    out.image = compose(pixels, options);
    return out;
}

}  // namespace frep
