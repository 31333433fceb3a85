// Implementation of png.h. libpng reports an error by longjmp: write_png, the only function that the jump
// crosses, has no object with a destructor; everything that owns memory lives in its callers.
#include "frep/io/png.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string_view>
#include <vector>

#include "frep/base/source.h"

namespace frep {

namespace {

/// What one call of encode_png writes, and where.
struct PngJob {
    const Image* image = nullptr;
    const PngOptions* options = nullptr;
    bool opaque = false;
    std::array<png_text, 4> texts{};
    int text_count = 0;
    std::vector<std::uint8_t> row;  ///< one row as RGB, for opaque pictures
    std::string bytes;
    std::string failure;
};

// clang-format off
[[noreturn]] void on_error(png_structp png, png_const_charp message) {
    PngJob* job = static_cast<PngJob*>(png_get_error_ptr(png));
    try { job->failure = message; } catch (const std::bad_alloc&) { job->failure.clear(); }
    png_longjmp(png, 1);
}
// clang-format on

void on_warning(png_structp, png_const_charp) {}

void append_bytes(png_structp png, png_bytep data, std::size_t size) {
    PngJob* job = static_cast<PngJob*>(png_get_io_ptr(png));
    bool done = false;
    try {
        job->bytes.append(reinterpret_cast<const char*>(data), size);
        done = true;
    } catch (const std::bad_alloc&) {
    }
    if (!done) png_error(png, "out of memory");
}

void flush_nothing(png_structp) {}

/// Row `y` as libpng wants it.
const std::uint8_t* row_of(PngJob& job, int y) {
    const std::size_t width = static_cast<std::size_t>(job.image->width);
    const std::uint8_t* row = job.image->pixels.data() + std::size_t{4} * width * static_cast<std::size_t>(y);
    if (!job.opaque) return row;
    for (std::size_t x = 0; x < width; ++x) {
        for (std::size_t c = 0; c < 3; ++c) job.row[3 * x + c] = row[4 * x + c];
    }
    return job.row.data();
}

void write_header(png_structp png, png_infop info, PngJob& job) {
    png_set_compression_level(png, job.options->compression);
    png_set_IHDR(png, info, static_cast<png_uint_32>(job.image->width),
                 static_cast<png_uint_32>(job.image->height), 8,
                 job.opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (job.options->pixels_per_meter > 0) {
        const png_uint_32 density = static_cast<png_uint_32>(job.options->pixels_per_meter);
        png_set_pHYs(png, info, density, density, PNG_RESOLUTION_METER);
    }
    if (job.text_count > 0) png_set_text(png, info, job.texts.data(), job.text_count);
    png_write_info(png, info);
}

/// False when libpng reported an error. A jump skips what follows it; nothing here needs a destructor.
bool write_png(png_structp png, png_infop info, PngJob& job) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_write_fn(png, &job, append_bytes, flush_nothing);
    write_header(png, info, job);
    for (int y = 0; y < job.image->height; ++y) png_write_row(png, row_of(job, y));
    png_write_end(png, info);
    return true;
}

/// Valid UTF-8 without control characters (C0, DEL, C1): U+FFFD stands in their place.
std::string clean_text(std::string_view bytes) {
    const std::string text = to_valid_utf8(bytes);
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const unsigned char c = static_cast<unsigned char>(text[i]);
        const bool c1 = c == 0xc2 && static_cast<unsigned char>(text[i + 1]) < 0xa0;
        if (c1) ++i;
        if (c1 || c < 0x20 || c == 0x7f) {
            out += "\xef\xbf\xbd";
        } else {
            out += text[i];
        }
    }
    return out;
}

bool is_ascii(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// Fills job.texts; the arrays must outlive the writing.
void list_texts(PngJob& job, std::array<std::string, 4>& cleaned) {
    static std::array<char[10], 4> keywords{{"Title", "Author", "Copyright", "Software"}};
    static char empty[] = "";
    const PngOptions& options = *job.options;
    const std::array<const std::string*, 4> given{&options.title, &options.author, &options.license,
                                                  &options.software};
    for (std::size_t i = 0; i < given.size(); ++i) {
        cleaned[i] = clean_text(*given[i]);
        if (cleaned[i].empty()) continue;
        png_text& text = job.texts[static_cast<std::size_t>(job.text_count++)];
        const bool ascii = is_ascii(cleaned[i]);
        text.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        text.key = keywords[i];
        text.text = cleaned[i].data();
        text.text_length = ascii ? cleaned[i].size() : 0;
        text.itxt_length = ascii ? 0 : cleaned[i].size();
        text.lang = empty;
        text.lang_key = empty;
    }
}

Status check_input(const Image& image, const PngOptions& options) {
    const auto invalid = [](std::string message) {
        return Status(Error{ErrorKind::invalid_argument, std::move(message)});
    };
    constexpr int longest = PNG_USER_WIDTH_MAX;
    if (image.width < 1 || image.height < 1 || image.width > longest || image.height > longest)
        return invalid(
            fmt::format("a PNG file cannot hold a picture of {} x {} pixels", image.width, image.height));
    const std::size_t bytes =
        std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (image.pixels.size() != bytes)
        return invalid(fmt::format("a picture of {} x {} pixels has {} bytes", image.width, image.height,
                                   image.pixels.size()));
    if (options.compression < 0 || options.compression > 9)
        return invalid(fmt::format("the PNG compression {} is not 0 to 9", options.compression));
    if (options.pixels_per_meter < 0)
        return invalid(fmt::format("{} pixels a meter is negative", options.pixels_per_meter));
    return {};
}

}  // namespace

bool is_opaque(const Image& image) {
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
        if (image.pixels[i] != 255) return false;
    }
    return true;
}

Result<std::string> encode_png(const Image& image, const PngOptions& options) {
    if (const Status status = check_input(image, options); !status) return status.error();
    PngJob job;
    job.image = &image;
    job.options = &options;
    job.opaque = is_opaque(image);
    if (job.opaque) job.row.resize(std::size_t{3} * static_cast<std::size_t>(image.width));
    std::array<std::string, 4> cleaned;
    list_texts(job, cleaned);
    const Error no_memory{ErrorKind::over_limit, "there is no memory left to write the PNG file"};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning);
    if (!png) return no_memory;
    png_infop info = png_create_info_struct(png);
    const bool done = info && write_png(png, info, job);
    png_destroy_write_struct(&png, &info);
    if (!info && !done && job.failure.empty()) return no_memory;
    if (!done) return Error{ErrorKind::over_limit, fmt::format("cannot write the PNG file: {}", job.failure)};
    return std::move(job.bytes);
}

Result<Image> decode_png(std::string_view bytes, std::int64_t most_pixels) {
    // libpng's simplified interface: it jumps within itself only and reports by its return value.
    png_image file{};
    file.version = PNG_IMAGE_VERSION;
    const auto broken = [&file] {
        const std::string why = file.message;
        png_image_free(&file);
        return Error{ErrorKind::invalid_argument, fmt::format("cannot read the PNG file: {}", why)};
    };
    if (!png_image_begin_read_from_memory(&file, bytes.data(), bytes.size())) return broken();
    if (std::int64_t{file.width} * std::int64_t{file.height} > most_pixels) {
        png_image_free(&file);
        return Error{ErrorKind::over_limit, fmt::format("the picture has more than {} pixels", most_pixels)};
    }
    file.format = PNG_FORMAT_RGBA;
    Image image = Image::sized(static_cast<int>(file.width), static_cast<int>(file.height));
    if (!png_image_finish_read(&file, nullptr, image.pixels.data(), 0, nullptr)) return broken();
    return image;
}

}  // namespace frep
