// Reads zip archives in tests, from the central directory, independently of io/zip.cpp; zlib inflates.
#pragma once

#include <doctest/doctest.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

namespace frep::test {

struct Unzipped {
    std::string name, bytes;
    std::uint32_t method = 0, time = 0, date = 0;
};

inline std::uint32_t little(const std::string& bytes, std::size_t at, std::size_t count) {
    REQUIRE(at + count <= bytes.size());
    std::uint32_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

inline std::string inflated(const std::string& packed, std::size_t size) {
    std::string out(size + 1, '\0');
    z_stream stream{};
    REQUIRE(inflateInit2(&stream, -15) == Z_OK);
    std::string in = packed;
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    CHECK(inflate(&stream, Z_FINISH) == Z_STREAM_END);
    CHECK(stream.total_out == size);
    inflateEnd(&stream);
    out.resize(size);
    return out;
}

/// The entries of an archive whose end record has no comment. Checks both headers, sizes and checksums.
inline std::vector<Unzipped> unzip(const std::string& archive) {
    std::vector<Unzipped> entries;
    REQUIRE(archive.size() >= 22);
    const std::size_t end = archive.size() - 22;
    REQUIRE(little(archive, end, 4) == 0x06054b50);
    const std::uint32_t count = little(archive, end + 10, 2), directory = little(archive, end + 16, 4);
    CHECK(little(archive, end + 8, 2) == count);
    CHECK(directory + little(archive, end + 12, 4) == end);
    std::size_t at = directory;
    for (std::uint32_t i = 0; i < count; ++i) {
        REQUIRE(little(archive, at, 4) == 0x02014b50);
        const std::size_t local = little(archive, at + 42, 4);
        REQUIRE(little(archive, local, 4) == 0x04034b50);
        // Version to the length of the extra field stand alike in both headers.
        CHECK(archive.substr(local + 4, 26) == archive.substr(at + 6, 26));
        Unzipped entry;
        entry.method = little(archive, at + 10, 2);
        entry.time = little(archive, at + 12, 2);
        entry.date = little(archive, at + 14, 2);
        const std::uint32_t packed = little(archive, at + 20, 4), size = little(archive, at + 24, 4);
        const std::uint32_t name = little(archive, at + 28, 2);
        entry.name = archive.substr(at + 46, name);
        CHECK(archive.substr(local + 30, name) == entry.name);
        const std::string kept = archive.substr(local + 30 + name, packed);
        entry.bytes = entry.method == 8 ? inflated(kept, size) : kept;
        CHECK(entry.bytes.size() == size);
        CHECK(little(archive, at + 16, 4) ==
              crc32(0, reinterpret_cast<const Bytef*>(entry.bytes.data()), size));
        entries.push_back(entry);
        at += 46 + name;
    }
    CHECK(at == end);
    return entries;
}

}  // namespace frep::test
