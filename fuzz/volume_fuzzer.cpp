// libFuzzer target: voxel files, NRRD (the file that a header names has the bytes of the file itself) and
// OpenVDB. Samples that come out must be finite, as many as the grid says, and no more than the file can
// hold: what compression may make of a byte is bounded.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "frep/io/read_volume.h"

/// OpenVDB 10 loses the nodes that it made when the rest of a damaged file is missing: no leak of ours.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:openvdb\n"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
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
