// Tests of io/zip.h: an archive is read back here from its records, by zlib's own inflate and crc32.
#include "frep/io/zip.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include "unit/io/unzip.h"

using namespace frep;

TEST_CASE("what goes in comes out") {
    std::string numbers;
    for (std::uint64_t i = 0; i < 300000; ++i)
        numbers += std::to_string(i * 7919 % 100003);  // more than one piece
    REQUIRE(numbers.size() > (std::size_t{1} << 20));
    const std::vector<ZipEntry> entries{{"a/\xe6\xbc\x86.txt", "hello"},
                                        {"empty", ""},
                                        {"numbers", numbers},
                                        {"zeros", std::string(5000, '\0')}};
    const auto archive = zip(entries);
    REQUIRE(static_cast<bool>(archive));
    const std::vector<test::Unzipped> read = test::unzip(*archive);
    REQUIRE(read.size() == entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
        CAPTURE(i);
        CHECK(read[i].name == entries[i].name);
        CHECK(read[i].bytes == entries[i].bytes);
        CHECK(read[i].date == 0x0021);  // 1980-01-01
        CHECK(read[i].time == 0);
    }
    CHECK(read[0].method == 0);  // five bytes do not get shorter
    CHECK(read[3].method == 8);
    CHECK(archive->size() < numbers.size());
    CHECK(*archive == *zip(entries));
}

TEST_CASE("an archive without entries is its end record") {
    const auto archive = zip({});
    REQUIRE(static_cast<bool>(archive));
    CHECK(*archive == std::string("PK\5\6", 4) + std::string(18, '\0'));
}

TEST_CASE("names that an archive cannot have") {
    CHECK_FALSE(static_cast<bool>(zip({{"", "x"}})));
    CHECK_FALSE(static_cast<bool>(zip({{"a", "x"}, {"a", "y"}})));
    CHECK_FALSE(static_cast<bool>(zip({{std::string(65536, 'a'), "x"}})));
    CHECK(static_cast<bool>(zip({{std::string(65535, 'a'), "x"}})));
    const auto crowd = zip(std::vector<ZipEntry>(65535, ZipEntry{"a", ""}));
    REQUIRE_FALSE(static_cast<bool>(crowd));
    CHECK(crowd.error().kind == ErrorKind::over_limit);
}
