// What drawings, fonts and voxel files hold. See info_file.h.
#include "info_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "json.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

constexpr std::size_t file_limit = std::size_t{1} << 30;

/// Lines of text and the same as JSON, in one order.
class Facts {
  public:
    Facts(std::string_view path, std::string_view what) {
        add("file", std::string(path));
        add("kind", std::string(what));
        json_.emplace("schema", "frep.info/1");
    }

    void add(std::string_view key, const std::string& value) {
        if (!value.empty()) text_ += fmt::format("{:<11} {}\n", key, escape_controls(value));
        json_[name(key)] = json_text(value);
    }
    void add(std::string_view key, const std::vector<double>& values) {
        std::string line;
        Json list = Json::array();
        for (const double value : values) {
            line += fmt::format("{}{:.6g}", line.empty() ? "" : " ", value);
            list.push_back(json_number(value));
        }
        text_ += fmt::format("{:<11} {}\n", key, line);
        json_[name(key)] = values.size() == 1 ? list[0] : list;
    }
    void add(std::string_view key, std::size_t count) { add(key, std::vector{static_cast<double>(count)}); }
    void add_notes(const std::vector<std::string>& notes) {
        Json list = Json::array();
        for (const std::string& note : notes) {
            text_ += fmt::format("{:<11} {}\n", "note", escape_controls(note));
            list.push_back(json_text(note));
        }
        json_["notes"] = std::move(list);
    }

    int print(bool json) const { return print_result(json ? json_bytes(json_) : text_); }

  private:
    static std::string name(std::string_view key) {
        std::string out(key);
        std::replace(out.begin(), out.end(), ' ', '_');
        return out;
    }

    std::string text_;
    Json json_ = Json::object();
};

Status describe_drawing(std::string_view bytes, Facts& facts) {
    const auto file = read_svg(bytes);
    if (!file) return file.error();
    std::size_t contours = 0, points = 0;
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (const FilledPart& part : file->area.parts)
        for (const auto& contour : part.contours) {
            ++contours;
            points += contour.size();
            for (const Vec2& p : contour) {
                low[0] = std::min(low[0], p.x), high[0] = std::max(high[0], p.x);
                low[1] = std::min(low[1], p.y), high[1] = std::max(high[1], p.y);
            }
        }
    facts.add("size", std::vector{high[0] - low[0], high[1] - low[1]});
    facts.add("bounds", std::vector{low[0], high[0], low[1], high[1]});
    facts.add("shapes", file->area.parts.size());
    facts.add("contours", contours);
    facts.add("points", points);
    facts.add_notes(file->notes);
    return {};
}

Status describe_font(std::string_view bytes, Facts& facts) {
    const auto font = font_facts(bytes);
    if (!font) return font.error();
    facts.add("format", font->format);
    facts.add("family", font->family);
    facts.add("style", font->style);
    facts.add("fonts", font->faces);
    facts.add("glyphs", font->glyphs);
    facts.add("characters", font->characters);
    facts.add("capitals", std::vector{font->capital_height});
    facts.add("kerning", font->has_kerning ? std::string("yes") : "no");
    facts.add_notes({});
    return {};
}

Status describe_volume(const std::string& path, std::string_view bytes, Facts& facts) {
    const auto file = read_volume(bytes, files_of_folder(std::filesystem::path(path).parent_path().string()));
    if (!file) return file.error();
    const Volume& v = file->volume;
    facts.add("samples", std::vector{static_cast<double>(v.size[0]), static_cast<double>(v.size[1]),
                                     static_cast<double>(v.size[2])});
    const auto length = [](const Vec3& axis) { return std::sqrt(dot(axis, axis)); };
    facts.add("spacing", std::vector{length(v.axes[0]), length(v.axes[1]), length(v.axes[2])});
    Box3 box{v.origin, v.origin};
    for (int corner = 1; corner < 8; ++corner) {
        Vec3 p = v.origin;
        for (std::size_t a = 0; a < 3; ++a)
            if (corner >> a & 1) p = p + v.axes[a] * static_cast<double>(v.size[a] - 1);
        box = joined(box, Box3{p, p});
    }
    facts.add("bounds", std::vector{box.min.x, box.max.x, box.min.y, box.max.y, box.min.z, box.max.z});
    const auto [least, most] = std::minmax_element(v.values.begin(), v.values.end());
    facts.add("values", std::vector{*least, *most});
    facts.add_notes(file->notes);
    return {};
}

}  // namespace

std::optional<NamedFile> named_file_kind(std::string_view path, std::string_view bytes) {
    constexpr NamedFile drawing{NamedFile::Kind::drawing, "an SVG drawing", "hfOutline(x, file)"};
    constexpr NamedFile font{NamedFile::Kind::font, "a font", "hfText(x, font, text, height)"};
    constexpr NamedFile volume{NamedFile::Kind::volume, "a voxel file", "hfVolume(x, file, level)"};
    struct Row {
        std::string_view extension;
        NamedFile file;
    };
    constexpr Row rows[] = {{".svg", drawing}, {".ttf", font},    {".otf", font},    {".ttc", font},
                            {".woff", font},   {".nrrd", volume}, {".nhdr", volume}, {".vdb", volume}};
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    for (const Row& row : rows)
        if (extension == row.extension) return row.file;
    using namespace std::string_view_literals;
    if (bytes.starts_with("NRRD000") || bytes.starts_with(" BDV\0\0\0\0"sv)) return volume;
    for (const std::string_view start : {"\0\1\0\0"sv, "OTTO"sv, "ttcf"sv, "wOFF"sv, "true"sv})
        if (bytes.starts_with(start)) return font;
    const std::string_view head = bytes.substr(0, 1000);
    if (head.starts_with('<') && head.find("<svg") != std::string_view::npos) return drawing;
    return std::nullopt;
}

std::optional<int> describe_file(const std::string& path, bool json) {
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    if (path.empty() || path == "-" || extension == ".hf" || extension == ".vm") return std::nullopt;
    const auto bytes = read_file(path, file_limit);
    if (!bytes) return fail(bytes.error());
    const auto found = named_file_kind(path, *bytes);
    if (!found && scene_read_format(path, *bytes)) {
        print_error(fmt::format("'{}' is a mesh file", path));
        print_help_line(fmt::format("`frep convert {} -o copy.glb --json` tells what it has", path));
        return exit_usage;
    }
    if (!found) return std::nullopt;
    const NamedFile kind = *found;
    Facts facts(path, kind.what.substr(kind.what.find(' ') + 1));
    Status status;
    switch (kind.kind) {
        case NamedFile::Kind::drawing:
            status = describe_drawing(*bytes, facts);
            break;
        case NamedFile::Kind::font:
            status = describe_font(*bytes, facts);
            break;
        case NamedFile::Kind::volume:
            status = describe_volume(path, *bytes, facts);
            break;
    }
    if (!status) return fail(Error{status.error().kind, fmt::format("{}: {}", path, status.error().message)});
    return facts.print(json);
}

}  // namespace frep::cli
