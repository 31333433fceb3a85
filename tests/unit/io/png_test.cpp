// Tests of io/png.h: what libpng reads back is what was encoded.
#include "frep/io/png.h"

#include <doctest/doctest.h>
#include <png.h>

#include <cstring>
#include <map>
#include <stdexcept>

using namespace frep;

namespace {

/// A file as libpng reads it.
struct Read {
    png_uint_32 width = 0, height = 0, density = 0;
    int color_type = -1, depth = 0;
    bool has_srgb = false, has_time = false;
    std::map<std::string, std::string> texts;
    std::map<std::string, int> compressions;
    std::vector<std::uint8_t> pixels;  ///< as RGBA
};

struct Cursor {
    const std::string* bytes;
    std::size_t at;
};

void take(png_structp png, png_bytep out, std::size_t size) {
    Cursor* cursor = static_cast<Cursor*>(png_get_io_ptr(png));
    if (cursor->bytes->size() - cursor->at < size) png_error(png, "the file ends early");
    std::memcpy(out, cursor->bytes->data() + cursor->at, size);
    cursor->at += size;
}

[[noreturn]] void fail(png_structp, png_const_charp message) { throw std::runtime_error(message); }
void ignore(png_structp, png_const_charp) {}

Read read_png(const std::string& bytes) {
    Read out;
    Cursor cursor{&bytes, 0};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
    png_infop info = png_create_info_struct(png);
    png_set_read_fn(png, &cursor, take);
    png_read_info(png, info);
    out.width = png_get_image_width(png, info);
    out.height = png_get_image_height(png, info);
    out.color_type = png_get_color_type(png, info);
    out.depth = png_get_bit_depth(png, info);
    out.has_srgb = png_get_valid(png, info, PNG_INFO_sRGB) != 0;
    out.density = png_get_pixels_per_meter(png, info);
    png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
    out.pixels.resize(std::size_t{4} * out.width * out.height);
    for (std::size_t y = 0; y < out.height; ++y)
        png_read_row(png, out.pixels.data() + y * out.width * 4, nullptr);
    png_read_end(png, info);
    out.has_time = png_get_valid(png, info, PNG_INFO_tIME) != 0;
    png_textp texts = nullptr;
    const int count = png_get_text(png, info, &texts, nullptr);
    for (int i = 0; i < count; ++i) {
        out.texts[texts[i].key] = texts[i].text;
        out.compressions[texts[i].key] = texts[i].compression;
    }
    png_destroy_read_struct(&png, &info, nullptr);
    return out;
}

Image pattern(int width, int height, bool opaque) {
    Image image = Image::sized(width, height);
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        state = state * 1664525u + 1013904223u;
        image.pixels[i] = opaque && i % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(state >> 24);
    }
    return image;
}

std::string encode(const Image& image, const PngOptions& options = {}) {
    const Result<std::string> bytes = encode_png(image, options);
    REQUIRE(static_cast<bool>(bytes));
    return *bytes;
}

}  // namespace

TEST_CASE("pixels come back as they were, with and without transparency") {
    for (const bool opaque : {true, false}) {
        const Image image = pattern(37, 23, opaque);
        const Read read = read_png(encode(image));
        CHECK(read.width == 37);
        CHECK(read.height == 23);
        CHECK(read.depth == 8);
        CHECK(read.color_type == (opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA));
        CHECK(read.has_srgb);
        CHECK_FALSE(read.has_time);
        CHECK(read.texts.empty());
        CHECK(read.density == 0);
        CHECK(read.pixels == image.pixels);
    }
}

TEST_CASE("every compression gives the same picture, and the same bytes twice") {
    const Image image = pattern(64, 64, true);
    for (int level = 0; level <= 9; ++level) {
        PngOptions options;
        options.compression = level;
        const std::string bytes = encode(image, options);
        CHECK(bytes == encode(image, options));
        CHECK(read_png(bytes).pixels == image.pixels);
    }
}

TEST_CASE("texts and the resolution") {
    PngOptions options;
    options.title = "Moai";
    options.author = "Galina Pasko, \xe4\xbc\x9a\xe6\xb4\xa5";
    options.license = "CC0-1.0";
    options.software = "frep";
    options.pixels_per_meter = 11811;
    Read read = read_png(encode(pattern(3, 2, false), options));
    CHECK(read.texts.size() == 4);
    CHECK(read.texts["Title"] == "Moai");
    CHECK(read.texts["Author"] == options.author);
    CHECK(read.texts["Copyright"] == "CC0-1.0");
    CHECK(read.texts["Software"] == "frep");
    CHECK(read.compressions["Title"] == PNG_TEXT_COMPRESSION_NONE);
    CHECK(read.compressions["Author"] == PNG_ITXT_COMPRESSION_NONE);
    CHECK(read.density == 11811);
}

TEST_CASE("malformed text cannot break the file") {
    PngOptions options;
    options.title = std::string("a\0b\n\xff\xed\xa0\x80", 8) + "c";
    const std::string bad = "\xef\xbf\xbd";
    Read read = read_png(encode(pattern(1, 1, true), options));
    CHECK(read.texts["Title"] == "a" + bad + "b" + bad + bad + bad + bad + bad + "c");
    options.title = "cut \xe4\xbc";
    read = read_png(encode(pattern(1, 1, true), options));
    CHECK(read.texts["Title"] == "cut " + bad + bad);
}

TEST_CASE("what is not a picture is an error") {
    const auto refused = [](const Image& image, const PngOptions& options = {}) {
        const Result<std::string> bytes = encode_png(image, options);
        return !bytes && bytes.error().kind == ErrorKind::invalid_argument;
    };
    CHECK(refused({}));
    CHECK(refused({0, 5, {}}));
    CHECK(refused({-1, 5, {}}));
    CHECK(refused({2, 2, std::vector<std::uint8_t>(15)}));
    CHECK(refused({2'000'000, 1, std::vector<std::uint8_t>(8'000'000)}));
    PngOptions options;
    options.compression = 10;
    CHECK(refused(pattern(2, 2, true), options));
    options.compression = 6;
    options.pixels_per_meter = -1;
    CHECK(refused(pattern(2, 2, true), options));
}
