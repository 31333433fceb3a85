// JSON as the command prints it: keys in the order of insertion, always valid UTF-8, no control characters.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "frep/frep.h"

namespace frep::cli {

using Json = nlohmann::ordered_json;

/// A text of the outside world as a JSON string: control characters escaped as in messages.
inline Json json_text(std::string_view text) { return escape_controls(to_valid_utf8(text)); }

/// null for numbers that JSON cannot hold.
inline Json json_number(double value) { return value - value == 0 ? Json(value) : Json(nullptr); }

/// The object as the bytes of a file or of standard output.
inline std::string json_bytes(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace frep::cli
