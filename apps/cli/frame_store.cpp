// Implementation of frame_store.h.
#include "frame_store.h"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "budget.h"

namespace frep::cli {

namespace {

namespace fs = std::filesystem;
constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr const char* key_name = "frames.key";

Error io_error(std::string message) { return {ErrorKind::io, std::move(message)}; }

bool is_frame(const fs::path& path) {
    const std::string name = path.filename().string();
    return name.starts_with("frame-") && name.ends_with(".png");
}

}  // namespace

Result<FrameStore> FrameStore::open(const std::string& output, const std::string& key) {
    FrameStore store(output + ".frames");
    std::error_code error;
    fs::create_directory(store.folder_, error);
    if (error || !fs::is_directory(store.folder_, error))
        return io_error(fmt::format("cannot make the folder '{}'", store.folder_));
    const std::string key_path = store.folder_ + "/" + key_name;
    const bool is_ours = fs::exists(key_path, error);
    if (!is_ours && !fs::is_empty(store.folder_, error))
        return io_error(
            fmt::format("'{}' is in the way: frames would be kept in a folder of that name", store.folder_));
    const auto old = is_ours ? read_file(key_path, most_bytes) : Result<std::string>("");
    if (old && *old == key) return store;
    for (const auto& entry : fs::directory_iterator(store.folder_, error))
        if (is_frame(entry.path())) fs::remove(entry.path(), error);
    const WritingFile guard;
    if (const Status status = write_file(key_path, key); !status) return status.error();
    return store;
}

std::string FrameStore::path(int frame) const {
    return fmt::format("{}/frame-{:05}.png", folder_, frame + 1);
}

bool FrameStore::has(int frame) const {
    std::error_code error;
    return fs::exists(path(frame), error);
}

Status FrameStore::put(int frame, const Image& image) const {
    PngOptions options;
    options.compression = 3;
    const auto bytes = encode_png(image, options);
    if (!bytes) return bytes.error();
    const WritingFile guard;
    return write_file(path(frame), *bytes);
}

Result<Image> FrameStore::get(int frame) const {
    const auto bytes = read_file(path(frame), most_bytes);
    if (!bytes) return bytes.error();
    auto image = decode_png(*bytes);
    if (!image) return Error{image.error().kind, fmt::format("'{}': {}", path(frame), image.error().message)};
    return image;
}

void FrameStore::remove(int frames) const {
    std::error_code error;
    for (int i = 0; i < frames; ++i) fs::remove(path(i), error);
    fs::remove(folder_ + "/" + key_name, error);
    fs::remove(folder_, error);  // stays when something else lies in it
}

}  // namespace frep::cli
