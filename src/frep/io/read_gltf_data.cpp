// Implementation of read_gltf_data.h.
#include "frep/io/read_gltf_data.h"

#include <fmt/format.h>

namespace frep::reading {

namespace {

constexpr int type_int8 = 5120, type_uint8 = 5121, type_int16 = 5122, type_uint16 = 5123, type_uint32 = 5125,
              type_float = 5126;

std::size_t component_bytes(int type) {
    switch (type) {
        case type_int8:
        case type_uint8:
            return 1;
        case type_int16:
        case type_uint16:
            return 2;
        case type_uint32:
        case type_float:
            return 4;
        default:
            return 0;
    }
}

std::size_t component_count(std::string_view type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    return type == "VEC4" ? 4 : 0;
}

Error bad(std::string message) { return {ErrorKind::io, std::move(message)}; }

/// What of the specification a reader must know to read the file at all (extensionsRequired), as far as this
/// one does: looks may be lost, shapes may not.
bool is_known_extension(std::string_view name) {
    return name.starts_with("KHR_materials_") || name == "KHR_mesh_quantization" ||
           name == "KHR_texture_transform" || name == "KHR_lights_punctual" || name == "KHR_texture_basisu" ||
           name == "EXT_texture_webp";
}

Status check_root(const Json& root) {
    const Json* asset = member(root, "asset");
    if (!asset) return bad("the JSON has no `asset`, which every glTF file has");
    const std::string_view version = text_member(*asset, "version");
    if (!version.starts_with("2."))
        return bad(fmt::format("asset.version is {}; glTF 2.0 is read", quoted(version)));
    const Json* required = array_member(root, "extensionsRequired");
    if (!required) return {};
    for (const Json& name : *required) {
        const std::string_view text =
            name.is_string() ? std::string_view(name.get_ref<const std::string&>()) : "?";
        if (!is_known_extension(text))
            return bad(fmt::format("the file requires the extension {}, which is not read", quoted(text)));
    }
    return {};
}

}  // namespace

std::optional<std::string> decode_base64(std::string_view text) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    std::string out;
    out.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        std::uint32_t value = 0;
        if (c >= 'A' && c <= 'Z') {
            value = static_cast<std::uint32_t>(c - 'A');
        } else if (c >= 'a' && c <= 'z') {
            value = static_cast<std::uint32_t>(c - 'a' + 26);
        } else if (c >= '0' && c <= '9') {
            value = static_cast<std::uint32_t>(c - '0' + 52);
        } else if (c == '+' || c == '/') {
            value = c == '+' ? 62 : 63;
        } else {
            return std::nullopt;
        }
        bits = (bits << 6 | value) & 0xffffffu;
        held += 6;
        if (held < 8) continue;
        held -= 8;
        out.push_back(static_cast<char>(bits >> held & 0xffu));
    }
    if (held == 6) return std::nullopt;
    return out;
}

double Accessor::number(std::size_t index, std::size_t component) const {
    const char* at = data.data() + index * stride + component * component_bytes(component_type);
    const auto scaled = [this](double value, double most) {
        if (!normalized) return value;
        return value < -most ? -1.0 : value / most;
    };
    switch (component_type) {
        case type_int8:
            return scaled(static_cast<std::int8_t>(load<std::uint8_t>(at)), 127);
        case type_uint8:
            return scaled(load<std::uint8_t>(at), 255);
        case type_int16:
            return scaled(static_cast<std::int16_t>(load<std::uint16_t>(at)), 32767);
        case type_uint16:
            return scaled(load<std::uint16_t>(at), 65535);
        case type_uint32:
            return load<std::uint32_t>(at);
        default:
            return static_cast<double>(load_float(at));
    }
}

std::uint32_t Accessor::integer(std::size_t index) const {
    const char* at = data.data() + index * stride;
    if (component_type == type_uint8) return load<std::uint8_t>(at);
    return component_type == type_uint16 ? load<std::uint16_t>(at) : load<std::uint32_t>(at);
}

Result<GltfData> GltfData::open(std::string_view bytes, const ReadOptions& options) {
    GltfData data;
    data.byte_count_ = bytes.size();
    if (bytes.starts_with("glTF")) {
        if (const Status status = data.open_container(bytes); !status) return status.error();
    } else {
        const std::size_t mark = bytes.starts_with("\xef\xbb\xbf") ? 3 : 0;
        auto root = parse_json(bytes.substr(mark), mark);
        if (!root) return root.error();
        data.root_ = std::move(*root);
    }
    if (const Status status = check_root(data.root_); !status) return status.error();
    if (const Status status = data.open_buffers(options); !status) return status.error();
    return data;
}

Status GltfData::open_container(std::string_view bytes) {
    constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
    if (bytes.size() < 20) return malformed_byte(bytes.size(), "the file ends in the header of GLB");
    if (const auto version = load<std::uint32_t>(bytes.data() + 4); version != 2)
        return malformed_byte(4, fmt::format("GLB version 2 is read, this is version {}", version));
    const std::size_t length = load<std::uint32_t>(bytes.data() + 8);
    if (length > bytes.size() || length < 20)
        return malformed_byte(
            8, fmt::format("the header states {} bytes, the file has {}", length, bytes.size()));
    std::size_t at = 12;
    for (int chunk = 0; at + 8 <= length; ++chunk) {
        const std::size_t size = load<std::uint32_t>(bytes.data() + at);
        const std::uint32_t type = load<std::uint32_t>(bytes.data() + at + 4);
        if (size > length - at - 8)
            return malformed_byte(at,
                                  fmt::format("a chunk states {} bytes, {} are left", size, length - at - 8));
        const std::string_view content = bytes.substr(at + 8, size);
        if (chunk == 0) {
            if (type != json_chunk) return malformed_byte(at + 4, "the first chunk is not JSON");
            auto root = parse_json(content, at + 8);
            if (!root) return root.error();
            root_ = std::move(*root);
        } else if (type == binary_chunk && !has_binary_) {
            binary_ = content;
            has_binary_ = true;
        }
        at += 8 + size;
    }
    return {};
}

Status GltfData::open_buffers(const ReadOptions& options) {
    const Json* list = array_member(root_, "buffers");
    if (!list) return {};
    for (std::size_t i = 0; i < list->size(); ++i) {
        const auto content = open_buffer(i, (*list)[i], options);
        if (!content) return content.error();
        buffers_.push_back(*content);
    }
    return {};
}

Result<std::string_view> GltfData::open_buffer(std::size_t index, const Json& buffer,
                                               const ReadOptions& options) {
    const auto length = as_index(member(buffer, "byteLength"));
    if (!length) return bad(fmt::format("buffers[{}].byteLength is no whole number", index));
    std::string_view content;
    const Json* uri = member(buffer, "uri");
    if (!uri) {
        if (index != 0 || !has_binary_)
            return bad(fmt::format("buffers[{}] has neither a uri nor a chunk BIN", index));
        content = binary_;
    } else {
        constexpr std::size_t file_limit = 64;
        const std::string_view text = text_member(buffer, "uri");
        if (text.starts_with("data:")) {
            const std::size_t comma = text.find(";base64,");
            auto decoded = decode_base64(comma == std::string_view::npos ? "*" : text.substr(comma + 8));
            if (!decoded) return bad(fmt::format("buffers[{}].uri is no base64 data", index));
            owned_.push_back(std::move(*decoded));
        } else {
            if (!options.read_companion || owned_.size() >= file_limit)
                return bad(fmt::format("buffers[{}] stands in a further file, {}, which is not read here",
                                       index, quoted(text)));
            auto file = options.read_companion(text);
            if (!file) return bad(fmt::format("buffers[{}]: {}", index, file.error().message));
            byte_count_ += file->size();
            owned_.push_back(std::move(*file));
        }
        content = owned_.back();
    }
    if (content.size() < *length)
        return bad(
            fmt::format("buffers[{}].byteLength is {}, there are {} bytes", index, *length, content.size()));
    return content.substr(0, *length);
}

Result<std::string_view> GltfData::view(std::size_t accessor, const Json& json, std::size_t& stride) const {
    const auto number = as_index(member(json, "bufferView"));
    const Json* entry = number ? item(root_, "bufferViews", *number) : nullptr;
    if (!entry) return bad(fmt::format("accessors[{}].bufferView names none of the bufferViews", accessor));
    const auto buffer = as_index(member(*entry, "buffer")), length = as_index(member(*entry, "byteLength"));
    if (!buffer || *buffer >= buffers_.size())
        return bad(fmt::format("bufferViews[{}].buffer names none of the buffers", *number));
    const Json* offset_entry = member(*entry, "byteOffset");
    const auto offset = offset_entry ? as_index(offset_entry) : std::optional<std::size_t>(0);
    const std::string_view bytes = buffers_[*buffer];
    if (!length || !offset || *offset > bytes.size() || *length > bytes.size() - *offset)
        return bad(fmt::format("bufferViews[{}] reaches beyond its buffer", *number));
    if (const Json* entry_stride = member(*entry, "byteStride")) {
        const auto value = as_index(entry_stride);
        if (!value || *value < 4 || *value > 252)
            return bad(fmt::format("bufferViews[{}].byteStride is not in 4..252", *number));
        stride = *value;
    }
    return bytes.substr(*offset, *length);
}

Result<Accessor> GltfData::accessor(std::size_t index) const {
    const Json* json = item(root_, "accessors", index);
    if (!json) return bad(fmt::format("there is no accessors[{}]", index));
    const auto name = [index](std::string_view rest) {
        return bad(fmt::format("accessors[{}]{}", index, rest));
    };
    if (member(*json, "sparse")) return name(" is sparse, which is not read");
    if (!member(*json, "bufferView")) return name(" has no bufferView");
    Accessor out;
    const auto type = as_index(member(*json, "componentType")), count = as_index(member(*json, "count"));
    out.components = component_count(text_member(*json, "type"));
    const std::size_t width = type && *type <= 5126 ? component_bytes(static_cast<int>(*type)) : 0;
    if (width == 0) return name(".componentType is none of 5120 to 5126");
    if (out.components == 0) return name(".type is not SCALAR, VEC2, VEC3 or VEC4");
    if (!count) return name(".count is no whole number");
    const Json* normalized = member(*json, "normalized");
    out.normalized = normalized && normalized->is_boolean() && normalized->get<bool>();
    out.component_type = static_cast<int>(*type);
    const std::size_t size = width * out.components;
    out.stride = size;
    const auto bytes = view(index, *json, out.stride);
    if (!bytes) return bytes.error();
    if (out.stride < size) return name(fmt::format(": its elements of {} bytes overlap", size));
    const Json* offset_entry = member(*json, "byteOffset");
    const auto offset = offset_entry ? as_index(offset_entry) : std::optional<std::size_t>(0);
    if (!offset || *offset > bytes->size()) return name(".byteOffset is beyond its bufferView");
    out.data = bytes->substr(*offset);
    out.count = *count;
    const bool fits =
        out.count == 0 || (out.data.size() >= size && out.count - 1 <= (out.data.size() - size) / out.stride);
    if (!fits) return name(fmt::format(": {} elements do not fit into its bufferView", out.count));
    return out;
}

}  // namespace frep::reading
