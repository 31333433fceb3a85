#include "frep/frep.h"

#include <filesystem>

namespace frep {

std::string_view version() { return FREP_VERSION; }

int numeric_profile() { return 1; }

Result<Model> compile(std::string_view text, std::string name) {
    Model model(Source(std::move(name), text));
    if (!model.ok()) return Error{ErrorKind::invalid_model, render(model.diagnostics(), model.source())};
    return model;
}

Result<Model> compile_file(const std::string& path) {
    auto bytes = read_file(path, lang::source_limit + 1);
    if (!bytes) return bytes.error();
    const std::filesystem::path place(path);
    const bool is_vm = lower_case(place.extension().string()) == ".vm";
    Model model(Source(path, *bytes), files_of_folder(place.parent_path().string()),
                is_vm ? ModelText::vm : ModelText::hyperfun);
    if (!model.ok()) return Error{ErrorKind::invalid_model, render(model.diagnostics(), model.source())};
    return model;
}

ReadFile files_of_folder(std::string folder) {
    return [folder = std::move(folder)](std::string_view name) -> Result<std::string> {
        namespace fs = std::filesystem;
        const fs::path relative{std::string(name)};
        const Error outside{ErrorKind::io, "a model may only read files inside its own folder"};
        if (name.empty() || relative.is_absolute()) return outside;
        fs::path path = folder.empty() ? fs::path(".") : fs::path(folder);
        for (const fs::path& part : relative) {
            if (part == "..") return outside;
            path /= part;
            std::error_code error;
            if (fs::is_symlink(fs::symlink_status(path, error)))
                return Error{ErrorKind::io, "a model may not read through links: " + std::string(name)};
        }
        constexpr std::size_t file_limit = std::size_t{1} << 30;
        return read_file(path.string(), file_limit);
    };
}

Result<ContourResult> contour(const Field& field, const ContourOptions& options, const Job& job) {
    auto evaluator = make_evaluator(field);
    if (!evaluator) return evaluator.error();
    const AxisMap map = AxisMap::standard((*evaluator)->coordinates());
    auto sampled = make_sampled_field(std::move(*evaluator), map);
    if (!sampled) return sampled.error();
    return contour_solid(**sampled, options, job);
}

Status write(const std::string& path, const Mesh& mesh, const MeshEncodeOptions& options) {
    const auto format = mesh_format_from_path(path);
    if (!format) return format.error();
    const auto bytes = encode_mesh(mesh, *format, options);
    if (!bytes) return bytes.error();
    return write_file(path, *bytes);
}

Status write(const std::string& path, const Scene& scene, const MeshEncodeOptions& options) {
    const auto format = mesh_format_from_path(path);
    if (!format) return format.error();
    MeshEncodeOptions named = options;
    if (named.stem.empty()) named.stem = stem_of_path(path);
    const auto files = encode_scene(scene, *format, named);
    if (!files) return files.error();
    return write_files(path, *files);
}

}  // namespace frep
