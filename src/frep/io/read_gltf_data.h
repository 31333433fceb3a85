// The data of a glTF 2.0 file (private to io): its JSON, its buffers, and accessors as numbers
// (sections 3.6.1 and 3.6.2 of the specification). Tested by tests/unit/io/read_gltf_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "frep/io/read_formats.h"
#include "frep/io/read_json.h"

namespace frep::reading {

/// An accessor's elements in the buffers: `count` elements of `components` numbers each.
struct Accessor {
    std::string_view data;  ///< from the first element on
    std::size_t count = 0, components = 1, stride = 0;
    int component_type = 0;  ///< 5120..5126
    bool normalized = false;

    /// Number `component` of element `index`; integers as they are or, if normalized, as 0..1 or -1..1.
    double number(std::size_t index, std::size_t component) const;
    /// Element `index` of a scalar accessor of unsigned integers.
    std::uint32_t integer(std::size_t index) const;
};

class GltfData {
  public:
    /// The file's JSON and buffers: a GLB container, or JSON whose buffers are data URIs or further files.
    /// Errors: io with byte or JSON place.
    static Result<GltfData> open(std::string_view bytes, const ReadOptions& options);

    const Json& root() const { return root_; }
    /// Bytes of the file and of the files that it names.
    std::size_t byte_count() const { return byte_count_; }

    /// Accessor `index` after all checks: its elements lie within the buffers. Errors: io, with the number of
    /// the accessor.
    Result<Accessor> accessor(std::size_t index) const;

  private:
    Status open_container(std::string_view bytes);
    Status open_buffers(const ReadOptions& options);
    Result<std::string_view> open_buffer(std::size_t index, const Json& buffer, const ReadOptions& options);
    Result<std::string_view> view(std::size_t accessor, const Json& json, std::size_t& stride) const;

    Json root_;
    std::string_view binary_;  ///< the GLB's chunk BIN
    bool has_binary_ = false;
    std::deque<std::string> owned_;  ///< decoded data URIs and files; a deque, so that views stay
    std::vector<std::string_view> buffers_;
    std::size_t byte_count_ = 0;
};

/// The bytes of base64 text (RFC 4648, section 4; with or without padding); nothing for other text.
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace frep::reading
