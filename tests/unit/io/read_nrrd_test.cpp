// NRRD: every type of numbers in both byte orders, the three encodings, detached data, places; headers that
// lie and files cut anywhere.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include <zlib.h>

#include "frep/io/read_volume.h"

using namespace frep;
using doctest::Approx;

namespace {

std::string header(std::string_view fields, std::string_view sizes = "2 3 2") {
    return "NRRD0004\n# made by a test\ndimension: 3\nsizes: " + std::string(sizes) + "\n" +
           std::string(fields);
}

/// The numbers 0..11 in `bytes` bytes each, each made by `bits`.
template <class Bits>
std::string numbers(Bits bits, std::size_t bytes, bool big) {
    std::string out;
    for (int i = 0; i < 12; ++i) {
        const std::uint64_t value = bits(i);
        for (std::size_t k = 0; k < bytes; ++k)
            out += static_cast<char>(value >> (8 * (big ? bytes - 1 - k : k)));
    }
    return out;
}

std::string packed(std::string_view data) {
    z_stream stream{};
    REQUIRE(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
    std::string out(deflateBound(&stream, data.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
    stream.avail_in = static_cast<uInt>(data.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

void check_numbers(const std::string& file, double scale = 1, const ReadBeside& beside = {}) {
    const auto read = read_volume(file, beside);
    if (!read) {
        FAIL_CHECK(read.error().message);
        return;
    }
    CHECK(read->volume.size == std::array<std::size_t, 3>{2, 3, 2});
    REQUIRE(read->volume.values.size() == 12);
    for (int i = 0; i < 12; ++i) CHECK(read->volume.values[static_cast<std::size_t>(i)] == scale * (i - 3));
}

std::string message_of(const std::string& file) {
    const auto read = read_volume(file);
    return read ? "no error" : read.error().message;
}

/// int16 numbers -3..8, little endian.
std::string shorts() {
    return numbers([](int i) { return static_cast<std::uint64_t>(i - 3); }, 2, false);
}
const char* const short_fields = "type: short\nendian: little\nencoding: raw\n\n";

}  // namespace

TEST_CASE("all types of numbers, both byte orders") {
    const auto whole = [](int i) { return static_cast<std::uint64_t>(i - 3); };
    const auto single = [](int i) {
        return std::uint64_t{std::bit_cast<std::uint32_t>(static_cast<float>(i - 3))};
    };
    const auto full = [](int i) { return std::bit_cast<std::uint64_t>(static_cast<double>(i - 3)); };
    for (const bool big : {false, true}) {
        CAPTURE(big);
        const std::string order =
            std::string("\nencoding: raw\nendian: ") + (big ? "big" : "little") + "\n\n";
        check_numbers(header("type: signed char" + order) + numbers(whole, 1, big));
        check_numbers(header("type: int16_t" + order) + numbers(whole, 2, big));
        check_numbers(header("type: int" + order) + numbers(whole, 4, big));
        check_numbers(header("type: long long" + order) + numbers(whole, 8, big));
        check_numbers(header("type: float" + order) + numbers(single, 4, big));
        check_numbers(header("type: Double" + order) + numbers(full, 8, big));
        const auto large = read_volume(header("type: ushort" + order) + numbers(whole, 2, big));
        REQUIRE(large);
        CHECK(large->volume.values[0] == 65533);
        CHECK(read_volume(header("type: uint8" + order) + numbers(whole, 1, big))->volume.values[0] == 253);
        CHECK(read_volume(header("type: uint" + order) + numbers(whole, 4, big))->volume.values[0] ==
              4294967293.0);
    }
}

TEST_CASE("gzip, text, data beside the header, parts that are skipped") {
    check_numbers(header("type: short\nendian: little\nencoding: gzip\n\n") + packed(shorts()));
    check_numbers(header("type: short\nendian: little\nencoding: gz\nbyte skip: 5\n\n") +
                  packed("01234" + shorts()));
    check_numbers(header("type: float\nencoding: ascii\n\n") + "-3 -2 -1\n0 1 2 3 4\n5 6e0 7.0 8\n");
    check_numbers(header("type: short\nendian: little\nencoding: raw\nline skip: 2\nbyte skip: 3\n\n") +
                  "a\nb\nabc" + shorts());
    check_numbers(header("type: short\nendian: little\nencoding: raw\nbyte skip: -1\n\n") +
                  "anything at all" + shorts());
    const ReadBeside beside = [](std::string_view name) -> Result<std::string> {
        if (name == "a.raw") return shorts();
        return Error{ErrorKind::io, "no such file"};
    };
    check_numbers(header("type: short\nendian: little\nencoding: raw\ndata file: a.raw\n"), 1, beside);
    check_numbers(header("type: short\r\nendian: little\r\nencoding: raw\r\ndatafile: a.raw\r\n\r\n"), 1,
                  beside);
    CHECK(read_volume(header("type: short\nendian: little\nencoding: raw\ndata file: b.raw\n"), beside)
              .error()
              .message == "no such file");
    CHECK(message_of(header("type: short\nendian: little\nencoding: raw\ndata file: a.raw\n")) ==
          "line 8: there is no file access here");
    CHECK(message_of(header("type: short\nendian: little\nencoding: raw\ndata file: x%03d.raw 1 9 1\n")) ==
          "line 8: volumes in several data files are not read");
}

TEST_CASE("places of samples") {
    auto read = read_volume(
        header(std::string("spacings: 0.5 2 nan\nspace origin: (1,2,3)\nkey:=value\n") + short_fields) +
        shorts());
    REQUIRE(read);
    CHECK(read->volume.axes[0] == Vec3{0.5, 0, 0});
    CHECK(read->volume.axes[1] == Vec3{0, 2, 0});
    CHECK(read->volume.axes[2] == Vec3{0, 0, 1});
    CHECK(read->volume.origin == Vec3{1, 2, 3});
    read = read_volume(
        header(
            std::string("space: left-posterior-superior\nspace directions: (0, 1,0) (-1,0,0) (0,0,2.5)\n") +
            short_fields) +
        shorts());
    REQUIRE(read);
    CHECK(read->volume.axes[0] == Vec3{0, 1, 0});
    CHECK(read->volume.axes[1] == Vec3{-1, 0, 0});
    CHECK(read->volume.axes[2] == Vec3{0, 0, 2.5});
    read = read_volume(header(std::string("axis mins: 0 0 0\n") + short_fields) + shorts());
    REQUIRE(read);
    CHECK(read->notes.size() == 1);
    // an axis of one sample more, as programs write for one channel
    const std::string four =
        "NRRD0005\ntype: short\ndimension: 4\nsizes: 1 2 3 2\nspacings: nan 1 2 3\nendian: little\nencoding: "
        "raw\n\n";
    read = read_volume(four + shorts());
    REQUIRE(read);
    CHECK(read->volume.size == std::array<std::size_t, 3>{2, 3, 2});
    CHECK(read->volume.axes[2] == Vec3{0, 0, 3});
}

TEST_CASE("headers that are wrong or lie") {
    const std::string data = shorts();
    CHECK(message_of("P5 2 2 255 abcd") == "neither NRRD nor OpenVDB");
    CHECK(message_of("NRRD0004\ntype: short\ndimension 3\n") ==
          "line 3: expected `field: value`, found `dimension 3`");
    CHECK(message_of("NRRD0004\ntype: short\nsizes: 2 2 2\n") == "the header has no `dimension`");
    CHECK(message_of(header("encoding: raw\n\n")) == "the header has no `type`");
    CHECK(message_of(header("type: block\nencoding: raw\n\n")) == "line 5: no type `block` of numbers");
    CHECK(message_of(header("type: short\nencoding: raw\n\n")) == "the header has no `endian`");
    CHECK(message_of(header("type: short\nencoding: raw\nendian: middle\n\n")) ==
          "line 7: expected `little` or `big`, found `middle`");
    CHECK(message_of(header("type: short\nencoding: bzip2\n\n")) ==
          "line 6: encoding `bzip2` is not read: raw, gzip and ascii are");
    CHECK(message_of(header(short_fields, "2 3") + data) == "line 4: expected 3 sizes, found 2");
    CHECK(message_of(header(short_fields, "2 -3 2") + data) == "line 4: expected a size, found `-3`");
    CHECK(message_of(header(short_fields, "2 1 6") + data) == "line 4: an axis has fewer than 2 samples");
    CHECK(message_of(header(short_fields, "2 99999999999999999999 6")) ==
          "line 4: expected a size, found `99999999999999999999`");
    const auto vast = read_volume(header(short_fields, "1099511627776 1099511627776 1099511627776") + data);
    CHECK(vast.error().kind == ErrorKind::over_limit);
    CHECK(message_of(header(short_fields, "512 512 512") + data) == "the data have 12 of 134217728 samples");
    CHECK(message_of(header("type: short\nendian: little\nencoding: gzip\n\n", "512 512 512") +
                     packed(data)) == "the data have 12 of 134217728 samples");
    CHECK(message_of(header("type: short\nendian: little\nencoding: gzip\n\n") + "no gzip") ==
          "the gzip data are damaged");
    CHECK(message_of(header("type: float\nencoding: ascii\n\n") + "1 2 3 4 5 6 7 8 9 10 11 x") ==
          "expected a number, found `x`");
    CHECK(message_of(header("type: float\nencoding: ascii\n\n") + "1 2 3 4 5 6 7 8 9 10 11 nan") ==
          "a sample is not finite");
    CHECK(message_of(header(std::string("spacings: 1 0 1\n") + short_fields) + data) ==
          "the axes of the grid do not span space");
    CHECK(message_of(header(std::string("spacings: 1 inf 1\n") + short_fields) + data) ==
          "the axes of the grid do not span space");
    CHECK(message_of(header(std::string("space directions: (1,0,0) (0,1) (0,0,1)\n") + short_fields) +
                     data) == "line 5: expected a direction as (x,y,z), found `(0,1)`");
    CHECK(message_of(header("type: short\nendian: little\nencoding: raw\nbyte skip: -2\n\n") + data) ==
          "line 8: expected a count, found `-2`");
    CHECK(message_of("NRRD0004\ntype: short\nencoding: raw\ndimension: 3\nsizes: 2 2 2\nendian: big") ==
          "the header has no end (an empty line) and names no data file");
}

TEST_CASE("a file cut anywhere is refused; damage gives a volume or a message") {
    for (const std::string& whole :
         {header(std::string("spacings: 1 2 3\nspace origin: (0,0,1)\n") + short_fields) + shorts(),
          header("type: short\nendian: little\nencoding: gzip\n\n") + packed(shorts()),
          header("type: float\nencoding: ascii\n\n") + "-3 -2 -1 0 1 2 3 4 5 6 7 88"}) {
        REQUIRE(read_volume(whole));
        const bool is_text = whole.find("ascii") != std::string::npos,
                   is_packed = whole.find("gzip") != std::string::npos;
        for (std::size_t size = 0; size < whole.size(); ++size) {
            // the last digit and the check sum of gzip are not needed
            const bool enough =
                (is_text && size + 1 == whole.size()) || (is_packed && size + 12 >= whole.size());
            const auto read = read_volume(std::string_view(whole).substr(0, size));
            if (!enough) CHECK(!read);
            if (!read) CHECK(!read.error().message.empty());
        }
        for (std::size_t at = 0; at < whole.size(); ++at)
            for (const char c : {'\0', '9', '\n', '\xff'}) {
                std::string damaged = whole;
                damaged[at] = c;
                if (const auto read = read_volume(damaged); !read) CHECK(!read.error().message.empty());
            }
    }
}
