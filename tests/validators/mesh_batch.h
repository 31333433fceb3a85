// A batch: many meshes in one file, for judges that look at thousands in one process. For each mesh a line
//
//     mesh NAME EXPECTED VOLUME VERTICES TRIANGLES
//
// then 3 VERTICES coordinates (binary32) and 3 TRIANGLES vertex numbers (32 bits), little-endian. EXPECTED is
// `sound` or the fault that a judge must see: `open`, `misoriented`, `pinched` (a vertex with two fans) or
// `crossing` (a self-intersection). VOLUME is another estimate of the enclosed volume, or `-`. Written by
// write_random_solids.cpp, read by judge_cgal.cpp and judge.mjs.
#pragma once

#include <bit>
#include <cstdint>
#include <cstdio>
#include <istream>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace frep::test {

static_assert(std::endian::native == std::endian::little, "batches are little-endian");

struct BatchMesh {
    std::string name, expected = "sound";
    std::optional<double> volume = {};
    std::vector<float> coordinates = {};      ///< x, y, z of each vertex
    std::vector<std::uint32_t> corners = {};  ///< three vertices a triangle
};

inline void write_mesh(std::ostream& out, const BatchMesh& mesh) {
    char volume[32] = "-";
    if (mesh.volume) std::snprintf(volume, sizeof volume, "%.17g", *mesh.volume);
    out << "mesh " << mesh.name << ' ' << mesh.expected << ' ' << volume << ' ' << mesh.coordinates.size() / 3
        << ' ' << mesh.corners.size() / 3 << '\n';
    out.write(reinterpret_cast<const char*>(mesh.coordinates.data()),
              static_cast<std::streamsize>(mesh.coordinates.size() * sizeof(float)));
    out.write(reinterpret_cast<const char*>(mesh.corners.data()),
              static_cast<std::streamsize>(mesh.corners.size() * sizeof(std::uint32_t)));
}

/// The next mesh; nothing at the end of the batch. `broken` is set where the file is none.
inline std::optional<BatchMesh> read_mesh(std::istream& in, bool& broken) {
    std::string line, word, volume;
    if (!std::getline(in, line)) return std::nullopt;
    BatchMesh mesh;
    std::size_t vertices = 0, triangles = 0;
    std::istringstream head(line);
    if (!(head >> word >> mesh.name >> mesh.expected >> volume >> vertices >> triangles) || word != "mesh") {
        broken = true;
        return std::nullopt;
    }
    if (volume != "-") mesh.volume = std::stod(volume);
    mesh.coordinates.resize(3 * vertices);
    mesh.corners.resize(3 * triangles);
    in.read(reinterpret_cast<char*>(mesh.coordinates.data()),
            static_cast<std::streamsize>(mesh.coordinates.size() * sizeof(float)));
    in.read(reinterpret_cast<char*>(mesh.corners.data()),
            static_cast<std::streamsize>(mesh.corners.size() * sizeof(std::uint32_t)));
    broken = !in;
    if (broken) return std::nullopt;
    return mesh;
}

}  // namespace frep::test
