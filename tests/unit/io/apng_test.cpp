// Tests of io/apng.h: chunks, checksums and order are those of the standard, and each frame, put into a PNG
// file of its own, comes back from libpng bit for bit. Reading of PNG files (io/png.h) is tested here too.
#include "frep/io/apng.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include "frep/io/png.h"

using namespace frep;

namespace {

Image noise(int width, int height, std::uint32_t seed, bool opaque) {
    Image image = Image::sized(width, height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        seed = seed * 1664525u + 1013904223u;
        const bool smooth = i / 4 % 7 < 4;
        image.pixels[i] = i % 4 == 3 && opaque ? 255 : static_cast<std::uint8_t>(smooth ? i / 4 : seed >> 24);
    }
    return image;
}

std::uint32_t u32(std::string_view text, std::size_t at) {
    std::uint32_t v = 0;
    for (std::size_t i = 0; i < 4; ++i) v = v << 8 | static_cast<unsigned char>(text[at + i]);
    return v;
}

struct Chunk {
    std::string name, data, whole;
};
std::vector<Chunk> chunks_of(const std::string& bytes) {
    REQUIRE(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    std::vector<Chunk> out;
    for (std::size_t at = 8; at < bytes.size();) {
        const std::size_t size = u32(bytes, at);
        REQUIRE(at + 12 + size <= bytes.size());
        const std::string named = bytes.substr(at + 4, size + 4);
        CHECK(u32(bytes, at + 8 + size) ==
              crc32(0, reinterpret_cast<const Bytef*>(named.data()), static_cast<uInt>(named.size())));
        out.push_back({named.substr(0, 4), named.substr(4), bytes.substr(at, size + 12)});
        at += size + 12;
    }
    return out;
}

void append_chunk(std::string& out, const std::string& name, const std::string& data) {
    const auto put = [&](std::uint32_t v) {
        for (int i = 3; i >= 0; --i) out.push_back(static_cast<char>(v >> (8 * i)));
    };
    put(static_cast<std::uint32_t>(data.size()));
    const std::string named = name + data;
    out += named;
    put(static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(named.data()), static_cast<uInt>(named.size()))));
}

}  // namespace

TEST_CASE("an animated PNG: frames in order, each of them lossless") {
    for (const bool opaque : {true, false}) {
        std::vector<Image> frames;
        for (std::uint32_t i = 0; i < 3; ++i) frames.push_back(noise(37, 23, i, opaque));
        ApngOptions options;
        options.frames = 3;
        options.delay_numerator = 2;
        options.delay_denominator = 30;
        options.opaque = opaque;
        auto writer = ApngWriter::make(37, 23, options);
        REQUIRE(writer);
        for (const Image& frame : frames) REQUIRE(writer->add(frame));
        const auto bytes = writer->finish();
        REQUIRE(bytes);
        const std::vector<Chunk> chunks = chunks_of(*bytes);
        std::string order;
        for (const Chunk& chunk : chunks) order += chunk.name + " ";
        CHECK(order == "IHDR sRGB acTL fcTL IDAT fcTL fdAT fcTL fdAT IEND ");
        CHECK(u32(chunks[2].data, 0) == 3);
        CHECK(u32(chunks[2].data, 4) == 0);
        // a viewer of still pictures sees the first frame
        const auto still = decode_png(*bytes);
        REQUIRE(still);
        CHECK(still->pixels == frames[0].pixels);
        std::uint32_t sequence = 0;
        std::size_t frame = 0;
        for (const Chunk& chunk : chunks) {
            if (chunk.name == "fcTL") {
                CHECK(u32(chunk.data, 0) == sequence++);
                CHECK(u32(chunk.data, 4) == 37);
                CHECK(u32(chunk.data, 8) == 23);
                CHECK(chunk.data.substr(20, 4) == std::string("\0\2\0\x1e", 4));
            }
            const bool later = chunk.name == "fdAT";
            if (later) CHECK(u32(chunk.data, 0) == sequence++);
            if (!later && chunk.name != "IDAT") continue;
            std::string png = bytes->substr(0, 8) + chunks[0].whole;
            append_chunk(png, "IDAT", later ? chunk.data.substr(4) : chunk.data);
            png += chunks.back().whole;
            const auto image = decode_png(png);
            REQUIRE(image);
            CHECK(image->pixels == frames[frame++].pixels);
        }
        CHECK(frame == 3);
    }
}

TEST_CASE("wrong numbers of frames and sizes are refused") {
    ApngOptions options;
    options.frames = 1;
    auto writer = ApngWriter::make(8, 8, options);
    REQUIRE(writer);
    CHECK(!writer->add(Image::sized(8, 9)));
    CHECK(!writer->finish());
    CHECK(writer->add(Image::sized(8, 8)));
    CHECK(!writer->add(Image::sized(8, 8)));
    CHECK(!ApngWriter::make(0, 8, options));
    options.delay_denominator = 70000;
    CHECK(!ApngWriter::make(8, 8, options));
}

TEST_CASE("PNG files are read back; broken ones are refused") {
    const Image image = noise(19, 13, 5, false);
    const auto bytes = encode_png(image);
    REQUIRE(bytes);
    const auto back = decode_png(*bytes);
    REQUIRE(back);
    CHECK(back->width == 19);
    CHECK(back->height == 13);
    CHECK(back->pixels == image.pixels);
    CHECK(decode_png(*bytes, 19 * 13 - 1).error().kind == ErrorKind::over_limit);
    for (std::size_t size = 0; size + 20 < bytes->size(); size += 3)
        CHECK(!decode_png(bytes->substr(0, size)));
    for (std::size_t i = 0; i < bytes->size(); ++i) {  // no crash, whatever comes out
        std::string broken = *bytes;
        broken[i] = static_cast<char>(broken[i] ^ 0x41);
        static_cast<void>(decode_png(broken));
    }
}
