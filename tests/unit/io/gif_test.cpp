// Tests of io/gif.h: an independent decoder of GIF89a gives the frames back, within the palette.
#include "frep/io/gif.h"

#include <doctest/doctest.h>

#include <cstdlib>

using namespace frep;

namespace {

struct Decoded {
    int width = 0, height = 0, delay = 0;
    bool loops = false;
    std::vector<Image> frames;
};

/// Reads what a viewer would show. Throws std::string for a file that breaks the standard.
class Reader {
  public:
    explicit Reader(const std::string& bytes) : bytes_(bytes) {}

    Decoded read() {
        expect(take(6) == "GIF89a");
        out_.width = u16();
        out_.height = u16();
        expect(u8() == 0xf7);
        take(2);
        for (auto& color : palette_)
            for (auto& part : color) part = static_cast<std::uint8_t>(u8());
        canvas_ = Image::sized(out_.width, out_.height);
        for (int kind = u8(); kind != 0x3b; kind = u8()) {
            if (kind == 0x21)
                extension();
            else if (kind == 0x2c)
                frame();
            else
                expect(false);
        }
        expect(at_ == bytes_.size());
        return out_;
    }

  private:
    static void expect(bool good) {
        if (!good) throw std::string("not a GIF file");
    }
    int u8() {
        expect(at_ < bytes_.size());
        return static_cast<unsigned char>(bytes_[at_++]);
    }
    int u16() {
        const int low = u8();
        return low | u8() << 8;
    }
    std::string take(std::size_t n) {
        expect(at_ + n <= bytes_.size());
        at_ += n;
        return bytes_.substr(at_ - n, n);
    }
    void extension() {
        const int label = u8();
        if (label == 0xf9) {
            expect(u8() == 4);
            const int flags = u8();
            disposal_ = flags >> 2 & 7;
            transparent_ = flags & 1;
            out_.delay = u16();
            nothing_ = u8();
            expect(u8() == 0);
            return;
        }
        expect(label == 0xff);
        expect(take(static_cast<std::size_t>(u8())) == "NETSCAPE2.0");
        expect(u8() == 3 && u8() == 1 && u16() == 0 && u8() == 0);
        out_.loops = true;
    }
    void frame() {
        const int x0 = u16(), y0 = u16(), w = u16(), h = u16();
        expect(u8() == 0 && x0 + w <= out_.width && y0 + h <= out_.height);
        const std::vector<int> indexes = codes();
        expect(indexes.size() == static_cast<std::size_t>(w * h));
        for (int i = 0; i < w * h; ++i) {
            const int index = indexes[static_cast<std::size_t>(i)];
            if (transparent_ && index == nothing_) continue;
            const auto p = static_cast<std::size_t>(4 * ((y0 + i / w) * out_.width + x0 + i % w));
            for (std::size_t c = 0; c < 3; ++c)
                canvas_.pixels[p + c] = palette_[static_cast<std::size_t>(index)][c];
            canvas_.pixels[p + 3] = 255;
        }
        out_.frames.push_back(canvas_);
        if (disposal_ == 2) canvas_ = Image::sized(out_.width, out_.height);
    }
    std::vector<int> codes() {
        const int depth = u8(), clear = 1 << depth;
        std::string data;
        for (int size = u8(); size != 0; size = u8()) data += take(static_cast<std::size_t>(size));
        std::vector<std::vector<int>> table;
        const auto reset = [&] {
            table.clear();
            for (int i = 0; i < clear; ++i) table.push_back({i});
            table.resize(static_cast<std::size_t>(clear) + 2);
        };
        reset();
        std::vector<int> out;
        int width = depth + 1, before = -1;
        for (std::size_t bit = 0;;) {
            int code = 0;
            for (int i = 0; i < width; ++i, ++bit) {
                expect(bit / 8 < data.size());
                code |= (static_cast<unsigned char>(data[bit / 8]) >> (bit % 8) & 1) << i;
            }
            if (code == clear + 1) return out;
            if (code == clear) {
                reset();
                width = depth + 1;
                before = -1;
                continue;
            }
            const auto known = static_cast<int>(table.size());
            expect(code < known || (code == known && before >= 0));
            std::vector<int> run = code < known ? table[static_cast<std::size_t>(code)]
                                                : table[static_cast<std::size_t>(before)];
            if (code == known) run.push_back(run.front());
            if (before >= 0 && known < 4096) {
                std::vector<int> entry = table[static_cast<std::size_t>(before)];
                entry.push_back(run.front());
                table.push_back(entry);
            }
            if (table.size() == std::size_t{1} << width && width < 12) ++width;
            out.insert(out.end(), run.begin(), run.end());
            before = code;
        }
    }

    const std::string& bytes_;
    std::size_t at_ = 0;
    std::array<std::array<std::uint8_t, 3>, 256> palette_{};
    Image canvas_;
    int disposal_ = 0, transparent_ = 0, nothing_ = 0;
    Decoded out_;
};

/// A disk that moves over a gradient, or over nothing.
Image picture(int width, int height, int step, bool see_through) {
    Image image = Image::sized(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            auto* p = &image.pixels[static_cast<std::size_t>(4 * (y * width + x))];
            const int dx = x - 20 - 3 * step, dy = y - height / 2;
            const bool disk = dx * dx + dy * dy < 150;
            p[0] = static_cast<std::uint8_t>(disk ? 200 : 255 * x / width);
            p[1] = static_cast<std::uint8_t>(disk ? 30 : 255 * y / height);
            p[2] = static_cast<std::uint8_t>(disk ? 30 : 128);
            p[3] = see_through && !disk ? 0 : 255;
        }
    }
    return image;
}

std::string encode(const std::vector<Image>& frames, const GifOptions& options) {
    auto writer = GifWriter::make(frames[0].width, frames[0].height, gif_palette(frames), options);
    REQUIRE(writer);
    for (const Image& frame : frames) REQUIRE(writer->add(frame));
    return writer->finish();
}

}  // namespace

TEST_CASE("frames come back within the palette's precision") {
    for (const bool dither : {false, true}) {
        std::vector<Image> frames;
        for (int i = 0; i < 5; ++i) frames.push_back(picture(97, 41, i, false));
        const std::string bytes = encode(frames, {7, true, dither});
        const Decoded decoded = Reader(bytes).read();
        CHECK(decoded.width == 97);
        CHECK(decoded.height == 41);
        CHECK(decoded.delay == 7);
        CHECK(decoded.loops);
        REQUIRE(decoded.frames.size() == frames.size());
        for (std::size_t i = 0; i < frames.size(); ++i) {
            long sum = 0;
            int worst = 0;
            for (std::size_t k = 0; k < frames[i].pixels.size(); ++k) {
                const int d = std::abs(int{frames[i].pixels[k]} - int{decoded.frames[i].pixels[k]});
                sum += d;
                worst = std::max(worst, d);
            }
            CHECK(worst <= 40);
            CHECK(sum <= 9 * static_cast<long>(frames[i].pixels.size()));
        }
        CHECK(encode(frames, {7, true, dither}) == bytes);
    }
}

TEST_CASE("few colors come back exactly; equal frames cost little") {
    Image image = Image::sized(64, 64);
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        const bool on = (i / 4 % 64 / 8 + i / 4 / 64 / 8) % 2 == 0;
        for (std::size_t c = 0; c < 3; ++c) image.pixels[i + c] = on ? 255 : 0;
        image.pixels[i + 3] = 255;
    }
    const std::string one = encode({image}, {4, false, false});
    const std::string ten = encode(std::vector<Image>(10, image), {4, false, false});
    CHECK(ten.size() < one.size() + 9 * 40);
    const Decoded decoded = Reader(ten).read();
    CHECK(!decoded.loops);
    REQUIRE(decoded.frames.size() == 10);
    for (const Image& frame : decoded.frames) CHECK(frame.pixels == image.pixels);
}

TEST_CASE("transparent pixels are transparent in every frame") {
    std::vector<Image> frames;
    for (int i = 0; i < 4; ++i) frames.push_back(picture(80, 40, i, true));
    const std::string bytes = encode(frames, {});
    const Decoded decoded = Reader(bytes).read();
    REQUIRE(decoded.frames.size() == 4);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 3; k < frames[i].pixels.size(); k += 4)
            REQUIRE(decoded.frames[i].pixels[k] == frames[i].pixels[k]);
}

TEST_CASE("long codes: noise fills the table many times") {
    Image image = Image::sized(300, 200);
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        state = state * 1664525u + 1013904223u;
        image.pixels[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(state >> 24 & 0xc0);
    }
    const std::string bytes = encode({image}, {4, true, false});
    const Decoded decoded = Reader(bytes).read();
    REQUIRE(decoded.frames.size() == 1);
    std::size_t far = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        far += std::abs(int{decoded.frames[0].pixels[i]} - int{image.pixels[i]}) > 8;
    CHECK(far == 0);
}

TEST_CASE("what cannot be written is refused") {
    CHECK(!GifWriter::make(0, 10, {{{0, 0, 0}}}));
    CHECK(!GifWriter::make(10, 70000, {{{0, 0, 0}}}));
    CHECK(!GifWriter::make(10, 10, {}));
    CHECK(!GifWriter::make(10, 10, {{{0, 0, 0}}}, {0}));
    auto writer = GifWriter::make(10, 10, {{{0, 0, 0}}});
    REQUIRE(writer);
    CHECK(!writer->add(Image::sized(10, 11)));
}
