// Implementation of gif.h.
#include "frep/io/gif.h"

#include <algorithm>

#include <fmt/format.h>

#include "frep/io/encode.h"

namespace frep {

namespace {

constexpr std::uint8_t nothing = 255;  ///< index of a transparent pixel, or of one that stays

void append_u16(std::string& out, int value) {
    encode::append_little_endian(out, static_cast<std::uint32_t>(value), 2);
}

// The palette.

struct Counted {
    std::array<std::uint8_t, 3> color;  ///< 5 bits a channel
    std::uint32_t count;
};
struct ColorBox {
    std::size_t first, last;  ///< of the sorted colors
    std::uint64_t pixels;
    std::array<std::uint8_t, 3> low, high;

    int longest() const {
        int axis = 0;
        for (int a = 1; a < 3; ++a)
            if (side(a) > side(axis)) axis = a;
        return axis;
    }
    int side(int a) const {
        const auto i = static_cast<std::size_t>(a);
        return high[i] - low[i];
    }
    /// What a division is worth: long boxes with many pixels first.
    std::uint64_t weight() const {
        const auto l = static_cast<std::uint64_t>(side(longest()));
        return l * l * pixels;
    }
};

ColorBox box_of(const std::vector<Counted>& colors, std::size_t first, std::size_t last) {
    ColorBox box{first, last, 0, {31, 31, 31}, {0, 0, 0}};
    for (std::size_t i = first; i < last; ++i) {
        box.pixels += colors[i].count;
        for (std::size_t a = 0; a < 3; ++a) {
            box.low[a] = std::min(box.low[a], colors[i].color[a]);
            box.high[a] = std::max(box.high[a], colors[i].color[a]);
        }
    }
    return box;
}

/// Both parts of a box, which has two colors at least.
std::pair<ColorBox, ColorBox> divided(std::vector<Counted>& colors, const ColorBox& box) {
    const auto axis = static_cast<std::size_t>(box.longest());
    const auto begin = colors.begin() + static_cast<std::ptrdiff_t>(box.first);
    const auto end = colors.begin() + static_cast<std::ptrdiff_t>(box.last);
    std::stable_sort(begin, end,
                     [axis](const Counted& a, const Counted& b) { return a.color[axis] < b.color[axis]; });
    std::uint64_t seen = 0;
    std::size_t middle = box.first + 1;
    for (std::size_t i = box.first; i + 1 < box.last; ++i) {
        seen += colors[i].count;
        middle = i + 1;
        if (2 * seen >= box.pixels) break;
    }
    return {box_of(colors, box.first, middle), box_of(colors, middle, box.last)};
}

std::array<std::uint8_t, 3> mean(const std::vector<Counted>& colors, const ColorBox& box) {
    std::array<std::uint64_t, 3> sum{};
    for (std::size_t i = box.first; i < box.last; ++i)
        for (std::size_t a = 0; a < 3; ++a) sum[a] += std::uint64_t{colors[i].color[a]} * colors[i].count;
    std::array<std::uint8_t, 3> out{};
    for (std::size_t a = 0; a < 3; ++a)  // 0..31 to 0..255
        out[a] = static_cast<std::uint8_t>((sum[a] * 255 + box.pixels * 31 / 2) / (box.pixels * 31));
    return out;
}

// Codes of variable length (Welch 1984), as GIF packs them.

class CodeWriter {
  public:
    explicit CodeWriter(std::string& out) : out_(out), keys_(slots, 0), codes_(slots, 0) {
        out_.push_back(static_cast<char>(depth));
        emit(clear);
    }
    void add(std::uint8_t index) {
        if (prefix_ < 0) {
            prefix_ = index;
            return;
        }
        // keys begin at 1, so that 0 means free
        const std::uint32_t key = (static_cast<std::uint32_t>(prefix_) << 8 | index) + 1;
        std::size_t slot = key * 2654435761u >> 18 & (slots - 1);
        while (keys_[slot] != 0 && keys_[slot] != key) slot = (slot + 1) & (slots - 1);
        if (keys_[slot] == key) {
            prefix_ = codes_[slot];
            return;
        }
        emit(prefix_);
        if (next_ < limit) {
            keys_[slot] = key;
            codes_[slot] = static_cast<std::uint16_t>(next_++);
            if (next_ > 1 << width_ && width_ < 12) ++width_;
        } else {
            emit(clear);
            std::fill(keys_.begin(), keys_.end(), 0);
            next_ = end + 1;
            width_ = depth + 1;
        }
        prefix_ = index;
    }
    void finish() {
        if (prefix_ >= 0) emit(prefix_);
        emit(end);
        if (bit_count_ > 0) take_byte();
        flush();
        out_.push_back('\0');
    }

  private:
    static constexpr int depth = 8, clear = 1 << depth, end = clear + 1, limit = 4096;
    static constexpr std::size_t slots = 1 << 14;

    void emit(int code) {
        bits_ |= static_cast<std::uint32_t>(code) << bit_count_;
        bit_count_ += width_;
        while (bit_count_ >= 8) take_byte();
    }
    void take_byte() {
        block_.push_back(static_cast<char>(bits_ & 0xffu));
        bits_ >>= 8;
        bit_count_ = std::max(0, bit_count_ - 8);
        if (block_.size() == 255) flush();
    }
    void flush() {
        if (block_.empty()) return;
        out_.push_back(static_cast<char>(block_.size()));
        out_ += block_;
        block_.clear();
    }

    std::string& out_;
    std::string block_;
    std::vector<std::uint32_t> keys_;
    std::vector<std::uint16_t> codes_;
    std::uint32_t bits_ = 0;
    int bit_count_ = 0, width_ = depth + 1, next_ = end + 1, prefix_ = -1;
};

/// Thresholds of an 8 x 8 Bayer matrix, -31.5..31.5.
double threshold(int x, int y) {
    int v = 0;
    for (int bit = 0; bit < 3; ++bit) {
        const int a = x >> bit & 1, b = y >> bit & 1;
        v |= (a ^ b) << (5 - 2 * bit) | b << (4 - 2 * bit);
    }
    return v - 31.5;
}

}  // namespace

GifPalette gif_palette(std::span<const Image> examples) {
    std::vector<std::uint32_t> histogram(std::size_t{1} << 15, 0);
    for (const Image& image : examples) {
        for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4) {
            if (image.pixels[i + 3] < 128) continue;
            const std::size_t key = std::size_t{image.pixels[i]} >> 3 << 10 |
                                    std::size_t{image.pixels[i + 1]} >> 3 << 5 |
                                    std::size_t{image.pixels[i + 2]} >> 3;
            if (histogram[key] < 0xffffffffu) ++histogram[key];
        }
    }
    std::vector<Counted> colors;
    for (std::size_t key = 0; key < histogram.size(); ++key) {
        if (histogram[key] == 0) continue;
        colors.push_back({{static_cast<std::uint8_t>(key >> 10), static_cast<std::uint8_t>(key >> 5 & 31),
                           static_cast<std::uint8_t>(key & 31)},
                          histogram[key]});
    }
    GifPalette palette;
    if (colors.empty()) {
        palette.colors.push_back({0, 0, 0});
        return palette;
    }
    std::vector<ColorBox> boxes{box_of(colors, 0, colors.size())};
    while (boxes.size() < GifPalette::most_colors) {
        const auto best =
            std::max_element(boxes.begin(), boxes.end(),
                             [](const ColorBox& a, const ColorBox& b) { return a.weight() < b.weight(); });
        if (best->weight() == 0) break;
        const auto [low, high] = divided(colors, *best);
        *best = low;
        boxes.push_back(high);
    }
    for (const ColorBox& box : boxes) palette.colors.push_back(mean(colors, box));
    std::sort(palette.colors.begin(), palette.colors.end());
    return palette;
}

Result<GifWriter> GifWriter::make(int width, int height, GifPalette palette, const GifOptions& options) {
    const auto wrong = [](std::string message) {
        return Error{ErrorKind::invalid_argument, std::move(message)};
    };
    if (width < 1 || height < 1 || width > 65535 || height > 65535)
        return wrong(fmt::format("a GIF has 1 to 65535 pixels a side, not {} x {}", width, height));
    if (palette.colors.empty() || palette.colors.size() > GifPalette::most_colors)
        return wrong(fmt::format("a palette has 1 to {} colors", GifPalette::most_colors));
    if (options.hundredths < 1 || options.hundredths > 65535)
        return wrong("a frame of a GIF lasts 0.01 to 655.35 seconds");
    return GifWriter(width, height, std::move(palette), options);
}

GifWriter::GifWriter(int width, int height, GifPalette palette, const GifOptions& options)
    : width_(width),
      height_(height),
      palette_(std::move(palette)),
      options_(options),
      cache_(std::size_t{1} << 18, -1) {
    bytes_ = "GIF89a";
    append_u16(bytes_, width_);
    append_u16(bytes_, height_);
    bytes_ += {'\xf7', '\0', '\0'};  // 256 colors follow; background 0; square pixels
    for (std::size_t i = 0; i < 256; ++i) {
        for (std::size_t a = 0; a < 3; ++a)
            bytes_.push_back(i < palette_.colors.size() ? static_cast<char>(palette_.colors[i][a]) : '\0');
    }
    if (options_.loops) {
        bytes_ += std::string("\x21\xff\x0bNETSCAPE2.0\x03\x01", 16);
        append_u16(bytes_, 0);
        bytes_.push_back('\0');
    }
}

std::uint8_t GifWriter::nearest(int r, int g, int b) {
    const auto cut = [](int v) { return std::clamp(v, 0, 255); };
    const auto [red, green, blue] = std::array{cut(r), cut(g), cut(b)};
    std::int16_t& known = cache_[static_cast<std::size_t>(red >> 2 << 12 | green >> 2 << 6 | blue >> 2)];
    if (known >= 0) return static_cast<std::uint8_t>(known);
    // the middle of the cell, so that the answer does not depend on who asks first
    const std::array<int, 3> middle{(red & ~3) + 2, (green & ~3) + 2, (blue & ~3) + 2};
    long best = -1;
    for (std::size_t i = 0; i < palette_.colors.size(); ++i) {
        long distance = 0;
        constexpr std::array<int, 3> weights{3, 6, 1};  // of the eye
        for (std::size_t a = 0; a < 3; ++a) {
            const int d = middle[a] - palette_.colors[i][a];
            distance += weights[a] * d * d;
        }
        if (best >= 0 && distance >= best) continue;
        best = distance;
        known = static_cast<std::int16_t>(i);
    }
    return static_cast<std::uint8_t>(known);
}

void GifWriter::quantize(const Image& frame, std::vector<std::uint8_t>& out) {
    out.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    std::size_t at = 0;
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x, ++at) {
            const std::uint8_t* p = &frame.pixels[4 * at];
            if (p[3] < 128) {
                out[at] = nothing;
                continue;
            }
            const int shift = options_.dither ? static_cast<int>(threshold(x & 7, y & 7) / 8) : 0;
            out[at] = nearest(p[0] + shift, p[1] + shift, p[2] + shift);
        }
    }
}

Status GifWriter::add(const Image& frame) {
    if (frame.width != width_ || frame.height != height_ ||
        frame.pixels.size() !=
            std::size_t{4} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_))
        return Error{ErrorKind::invalid_argument,
                     fmt::format("all frames of a GIF have {} x {} pixels", width_, height_)};
    std::vector<std::uint8_t> indexes;
    quantize(frame, indexes);
    const bool clears = std::find(indexes.begin(), indexes.end(), nothing) != indexes.end();
    write_frame(indexes, clears);
    shown_ = std::move(indexes);
    see_through_ = clears;
    return {};
}

/// A frame with transparent pixels is written whole and taken away after its time; of the others only the
/// rectangle that differs from what is shown.
void GifWriter::write_frame(const std::vector<std::uint8_t>& indexes, bool clears) {
    int x0 = 0, y0 = 0, x1 = width_, y1 = height_;
    const bool is_change = !shown_.empty() && !clears && !see_through_;
    const auto at = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    };
    const auto differs = [&](int x, int y) { return indexes[at(x, y)] != shown_[at(x, y)]; };
    if (is_change) {
        const auto row_differs = [&](int y) {
            for (int x = 0; x < width_; ++x)
                if (differs(x, y)) return true;
            return false;
        };
        const auto column_differs = [&](int x) {
            for (int y = y0; y < y1; ++y)
                if (differs(x, y)) return true;
            return false;
        };
        while (y0 < y1 - 1 && !row_differs(y0)) ++y0;
        while (y1 > y0 + 1 && !row_differs(y1 - 1)) --y1;
        while (x0 < x1 - 1 && !column_differs(x0)) ++x0;
        while (x1 > x0 + 1 && !column_differs(x1 - 1)) --x1;
    }
    bytes_ += {'\x21', '\xf9', '\x04', static_cast<char>((clears ? 2 : 1) << 2 | 1)};
    append_u16(bytes_, options_.hundredths);
    bytes_ += {static_cast<char>(nothing), '\0', '\x2c'};
    for (const int v : {x0, y0, x1 - x0, y1 - y0}) append_u16(bytes_, v);
    bytes_.push_back('\0');
    CodeWriter codes(bytes_);
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) codes.add(is_change && !differs(x, y) ? nothing : indexes[at(x, y)]);
    codes.finish();
}

std::string GifWriter::finish() {
    bytes_.push_back(';');
    return std::move(bytes_);
}

}  // namespace frep
