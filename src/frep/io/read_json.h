// JSON for the readers (private to io): parsed without exceptions, with limited nesting, and read with types
// checked first. Tested by tests/unit/io/read_gltf_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "frep/base/result.h"

namespace frep::reading {

using Json = nlohmann::json;

/// Arrays and objects inside one another.
inline constexpr int json_depth_limit = 64;

/// The value of `text`, which stands at byte `offset` of its file. Errors: io with the byte for text that is
/// not JSON or is nested too deeply.
Result<Json> parse_json(std::string_view text, std::size_t offset);

/// The member called `key`; nothing when `object` is no object or has none.
const Json* member(const Json& object, const char* key);
/// The member when it is an array; else nothing.
const Json* array_member(const Json& object, const char* key);
/// Item `index` of the array `key`, when both are there.
const Json* item(const Json& object, const char* key, std::size_t index);

/// A whole number >= 0, written as 3 or as 3.0.
std::optional<std::size_t> as_index(const Json* value);
/// The number of that member, `otherwise` when there is none or it is no number.
double number_member(const Json& object, const char* key, double otherwise);
/// The text of that member; empty when there is none.
std::string_view text_member(const Json& object, const char* key);
/// Fills `out` with the numbers of that member; false, and `out` as it was, when it is no array of as many.
bool numbers_member(const Json& object, const char* key, double* out, std::size_t count);

}  // namespace frep::reading
