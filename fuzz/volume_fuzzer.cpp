// libFuzzer target: voxel files in NRRD; the file that a header names has the bytes of the file itself.
// OpenVDB is left to tests/unit/io/read_vdb_test.cpp: its library asks for the memory that a compressed block
// states, which fails as an exception in a program and ends one under the address sanitizer. Samples that
// come out must be finite, as many as the grid says, and within the limit.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "frep/io/read_volume.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (bytes.starts_with(" BDV")) return 0;
    const auto file = frep::read_volume(
        bytes, [bytes](std::string_view) { return frep::Result<std::string>(std::string(bytes)); });
    if (!file) return file.error().message.empty() ? std::abort(), 0 : 0;
    const auto& volume = file->volume;
    if (volume.values.size() != volume.size[0] * volume.size[1] * volume.size[2]) std::abort();
    if (volume.values.size() > frep::most_samples) std::abort();
    for (const double value : volume.values)
        if (value - value != 0) std::abort();
    return 0;
}
