// Implementation of read_json.h, over nlohmann-json.
#include "frep/io/read_json.h"

#include <fmt/format.h>

#include <string>

#include "frep/io/read_formats.h"

namespace frep::reading {

namespace {

/// Where the nesting exceeds the limit; nothing when it does not.
std::optional<std::size_t> too_deep(std::string_view text) {
    int depth = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_text) {
            if (c == '\\') ++i;
            if (c == '"') in_text = false;
        } else if (c == '"') {
            in_text = true;
        } else if (c == '[' || c == '{') {
            if (++depth > json_depth_limit) return i;
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return std::nullopt;
}

/// Takes the events of the parser and keeps where it fails.
struct PlaceOfError : nlohmann::json_sax<Json> {
    std::size_t place = 0;
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool key(string_t&) override { return true; }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t position, const std::string&, const Json::exception&) override {
        place = position;
        return false;
    }
};

}  // namespace

Result<Json> parse_json(std::string_view text, std::size_t offset) {
    if (const auto place = too_deep(text))
        return malformed_byte(offset + *place,
                              fmt::format("JSON is nested more than {} deep", json_depth_limit));
    Json value = Json::parse(text, nullptr, false);
    if (!value.is_discarded()) return value;
    PlaceOfError handler;
    Json::sax_parse(text, &handler);
    return malformed_byte(offset + (handler.place > 0 ? handler.place - 1 : 0), "this is not JSON");
}

const Json* member(const Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

const Json* array_member(const Json& object, const char* key) {
    const Json* value = member(object, key);
    return value && value->is_array() ? value : nullptr;
}

const Json* item(const Json& object, const char* key, std::size_t index) {
    const Json* array = array_member(object, key);
    return array && index < array->size() ? &(*array)[index] : nullptr;
}

std::optional<std::size_t> as_index(const Json* value) {
    if (!value) return std::nullopt;
    if (value->is_number_unsigned()) return value->get<std::size_t>();
    if (!value->is_number_float()) return std::nullopt;
    const double number = value->get<double>();
    if (!(number >= 0 && number < 0x1p53)) return std::nullopt;
    const auto whole = static_cast<std::size_t>(number);
    if (static_cast<double>(whole) != number) return std::nullopt;
    return whole;
}

double number_member(const Json& object, const char* key, double otherwise) {
    const Json* value = member(object, key);
    return value && value->is_number() ? value->get<double>() : otherwise;
}

std::string_view text_member(const Json& object, const char* key) {
    const Json* value = member(object, key);
    if (!value || !value->is_string()) return {};
    return value->get_ref<const std::string&>();
}

bool numbers_member(const Json& object, const char* key, double* out, std::size_t count) {
    const Json* array = array_member(object, key);
    if (!array || array->size() != count) return false;
    for (const Json& value : *array)
        if (!value.is_number()) return false;
    for (std::size_t i = 0; i < count; ++i) out[i] = (*array)[i].get<double>();
    return true;
}

}  // namespace frep::reading
