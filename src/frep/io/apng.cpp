// Implementation of apng.h.
#include "frep/io/apng.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

namespace frep {

namespace {

void append_big_endian(std::string& out, std::uint32_t value, int count = 4) {
    for (int i = count; i-- > 0;) out.push_back(static_cast<char>(value >> (8 * i) & 0xffu));
}

/// A chunk: length, name, data, and the checksum of name and data.
void append_chunk(std::string& out, std::string_view name, std::string_view data) {
    append_big_endian(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = out.size();
    out += name;
    out += data;
    const uLong crc = crc32(crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(out.data() + begin),
                            static_cast<uInt>(out.size() - begin));
    append_big_endian(out, static_cast<std::uint32_t>(crc));
}

int paeth(int left, int above, int corner) {
    const int guess = left + above - corner;
    const int a = std::abs(guess - left), b = std::abs(guess - above), c = std::abs(guess - corner);
    if (a <= b && a <= c) return left;
    return b <= c ? above : corner;
}

/// `row` by one of the five filters of PNG, `above` the row before; `step` bytes a pixel.
void filter_row(int kind, const std::vector<std::uint8_t>& row, const std::vector<std::uint8_t>& above,
                std::size_t step, std::vector<std::uint8_t>& out) {
    for (std::size_t i = 0; i < row.size(); ++i) {
        const int left = i >= step ? row[i - step] : 0, corner = i >= step ? above[i - step] : 0;
        const std::array<int, 5> guesses{0, left, above[i], (left + above[i]) / 2,
                                         kind == 4 ? paeth(left, above[i], corner) : 0};
        out[i] = static_cast<std::uint8_t>(row[i] - guesses[static_cast<std::size_t>(kind)]);
    }
}

long magnitude(const std::vector<std::uint8_t>& filtered) {
    long sum = 0;
    for (const std::uint8_t byte : filtered) sum += byte < 128 ? byte : 256 - byte;
    return sum;
}

Error wrong(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }

}  // namespace

Result<ApngWriter> ApngWriter::make(int width, int height, const ApngOptions& options) {
    if (width < 1 || height < 1 || width > 65535 || height > 65535)
        return wrong(fmt::format("an animated PNG has 1 to 65535 pixels a side, not {} x {}", width, height));
    if (options.frames < 1) return wrong("an animation has at least one frame");
    if (std::min(options.delay_numerator, options.delay_denominator) < 0 ||
        std::max(options.delay_numerator, options.delay_denominator) > 65535)
        return wrong("the numbers of a frame's time lie in 0..65535");
    return ApngWriter(width, height, options);
}

ApngWriter::ApngWriter(int width, int height, const ApngOptions& options)
    : width_(width), height_(height), options_(options) {
    bytes_ = "\x89PNG\r\n\x1a\n";
    std::string data;
    append_big_endian(data, static_cast<std::uint32_t>(width_));
    append_big_endian(data, static_cast<std::uint32_t>(height_));
    data += {'\x08', options_.opaque ? '\x02' : '\x06', '\0', '\0', '\0'};
    append_chunk(bytes_, "IHDR", data);
    append_chunk(bytes_, "sRGB", std::string_view("\0", 1));
    data.clear();
    append_big_endian(data, static_cast<std::uint32_t>(options_.frames));
    append_big_endian(data, options_.loops ? 0 : 1);
    append_chunk(bytes_, "acTL", data);
}

Result<std::string> ApngWriter::compressed(const Image& frame) const {
    const std::size_t step = options_.opaque ? 3 : 4, width = static_cast<std::size_t>(width_);
    std::vector<std::uint8_t> row(step * width), above(step * width, 0), best(step * width),
        tried(step * width);
    std::string raw;
    raw.reserve((step * width + 1) * static_cast<std::size_t>(height_));
    for (std::size_t y = 0; y < static_cast<std::size_t>(height_); ++y) {
        const std::uint8_t* pixels = &frame.pixels[4 * width * y];
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t c = 0; c < step; ++c) row[step * x + c] = pixels[4 * x + c];
        int kind = 0;
        long least = -1;
        for (int k = 0; k < 5; ++k) {
            filter_row(k, row, above, step, tried);
            const long sum = magnitude(tried);
            if (least >= 0 && sum >= least) continue;
            least = sum;
            kind = k;
            best.swap(tried);
        }
        raw.push_back(static_cast<char>(kind));
        raw.append(reinterpret_cast<const char*>(best.data()), best.size());
        above.swap(row);
    }
    uLongf size = compressBound(static_cast<uLong>(raw.size()));
    std::string out(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
                  static_cast<uLong>(raw.size()), 6) != Z_OK)
        return Error{ErrorKind::over_limit, "there is no memory left to compress"};
    out.resize(size);
    return out;
}

Status ApngWriter::add(const Image& frame) {
    if (frame.width != width_ || frame.height != height_ ||
        frame.pixels.size() !=
            std::size_t{4} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_))
        return wrong(fmt::format("all frames of an animation have {} x {} pixels", width_, height_));
    if (added_ == options_.frames)
        return wrong(fmt::format("more than the stated {} frames", options_.frames));
    const auto data = compressed(frame);
    if (!data) return data.error();
    std::string control;
    append_big_endian(control, sequence_++);
    append_big_endian(control, static_cast<std::uint32_t>(width_));
    append_big_endian(control, static_cast<std::uint32_t>(height_));
    append_big_endian(control, 0);
    append_big_endian(control, 0);
    append_big_endian(control, static_cast<std::uint32_t>(options_.delay_numerator), 2);
    append_big_endian(control, static_cast<std::uint32_t>(options_.delay_denominator), 2);
    control += {'\0', '\0'};  // leave the frame; replace what was there
    append_chunk(bytes_, "fcTL", control);
    if (added_++ == 0) {
        append_chunk(bytes_, "IDAT", *data);
    } else {
        std::string numbered;
        append_big_endian(numbered, sequence_++);
        append_chunk(bytes_, "fdAT", numbered + *data);
    }
    return {};
}

Result<std::string> ApngWriter::finish() {
    if (added_ != options_.frames)
        return wrong(fmt::format("{} of the stated {} frames came", added_, options_.frames));
    append_chunk(bytes_, "IEND", {});
    return std::move(bytes_);
}

}  // namespace frep
