// MTL (Wavefront material library) with the additions for physically based rendering (Pr, Pm, Pc): the
// diffuse color Kd is taken as sRGB. Tested by tests/unit/io/read_obj_test.cpp.
#include "frep/io/read_formats.h"

namespace frep::reading {

namespace {

double unit_range(double value) { return value > 0 ? (value < 1 ? value : 1) : 0; }

/// Numbers of the line up to the first word that is none.
std::size_t read_line_numbers(Words& words, double* out, std::size_t most) {
    std::size_t count = 0;
    std::string_view word;
    while (count < most && words.next_in_line(word)) {
        const auto value = parse_number<double>(word);
        if (!value) break;
        out[count++] = unit_range(*value);
    }
    return count;
}

}  // namespace

std::vector<NamedMaterial> read_mtl(std::string_view bytes) {
    std::vector<NamedMaterial> out;
    Words words(bytes, true, true);
    do {
        std::string_view keyword;
        if (!words.next_in_line(keyword)) continue;
        if (keyword == "newmtl") {
            out.push_back({object_name(words.rest_of_line()), {}});
            continue;
        }
        if (out.empty()) continue;
        Material& material = out.back().material;
        double n[3] = {0, 0, 0};
        if (keyword == "Kd") {
            const std::size_t count = read_line_numbers(words, n, 3);
            if (count == 1) material.base = {n[0], n[0], n[0]};
            if (count == 3) material.base = {n[0], n[1], n[2]};
        } else if (keyword == "Pr") {
            if (read_line_numbers(words, n, 1) == 1) material.roughness = n[0];
        } else if (keyword == "Pm") {
            if (read_line_numbers(words, n, 1) == 1) material.metallic = n[0];
        } else if (keyword == "Pc") {
            if (read_line_numbers(words, n, 1) == 1) material.clearcoat = n[0];
        }
    } while (words.next_line());
    return out;
}

}  // namespace frep::reading
