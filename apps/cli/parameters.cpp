// Implementation of parameters.h.
#include "parameters.h"

#include <algorithm>

#include <fmt/format.h>

#include "terminal.h"
#include "values.h"

namespace frep::cli {

namespace {

bool same_name(std::string_view a, std::string_view b) { return lower_case(a) == lower_case(b); }

/// 3 for `a[3]` and `a3`; nothing for other texts.
std::optional<std::int64_t> index_of(std::string_view name) {
    if (name.empty() || (name[0] != 'a' && name[0] != 'A')) return std::nullopt;
    name.remove_prefix(1);
    if (name.starts_with('[') && name.ends_with(']')) {
        name.remove_prefix(1);
        name.remove_suffix(1);
    }
    const auto index = parse_integer(name, 0, 1'000'000);
    if (!index) return std::nullopt;
    return *index;
}

/// Finds the parameters of one object by name.
class Names {
  public:
    Names(const Model& model, std::size_t object) : annotations_(model.program().annotations.parameters) {
        if (model.find_object({}) != object)
            count_ = 0;  // the annotations speak of the default object
        else
            count_ = annotations_.size();
    }

    /// The parameter's number, as it stands in the name; nothing when the name is unknown.
    std::optional<std::int64_t> look_up(std::string_view name) const {
        for (std::size_t i = 0; i < count_; ++i)
            if (same_name(annotations_[i].name, name)) return annotations_[i].index;
        return index_of(name);
    }

    /// The parameter's number, from 1; nothing when the name is unknown, which is printed.
    std::optional<std::int64_t> find(std::string_view name) const {
        if (const auto index = look_up(name)) {
            if (*index >= 1) return index;
            usage_error(fmt::format("--param: `{}`: parameters are counted from 1", name));
            return std::nullopt;
        }
        print_error(fmt::format("--param: the object has no parameter `{}`", name));
        suggest(name);
        return std::nullopt;
    }

  private:
    void suggest(std::string_view name) const {
        std::vector<std::string_view> known;
        for (std::size_t i = 0; i < count_; ++i) known.push_back(annotations_[i].name);
        if (const std::string_view near = nearest_name(name, known); !near.empty()) {
            print_help_line(fmt::format("did you mean `{}`?", near));
        } else {
            print_help_line(
                "a parameter is called by the name of its `--@ param` line or by a[1], a[2], ...");
        }
    }

    const std::vector<lang::ParameterAnnotation>& annotations_;
    std::size_t count_ = 0;
};

void warn_about_count(std::size_t given, std::size_t expected) {
    if (given > expected)
        print_warning(fmt::format("-a has {} values, the object has {} parameters: the rest is ignored",
                                  given, expected));
    if (given < expected)
        print_warning(
            fmt::format("-a has {} values, the object has {} parameters: the others take their defaults or 0",
                        given, expected));
}

}  // namespace

std::optional<std::vector<double>> read_parameters(const Model& model, std::size_t object,
                                                   const std::optional<std::string>& values,
                                                   const std::vector<std::string>& named) {
    const auto count = static_cast<std::size_t>(model.program().objects[object].parameters());
    std::vector<double> given;
    if (values && !values->empty()) {
        const auto list = parse_numbers(*values);
        if (!list) return usage_error("-a: " + list.error().message), std::nullopt;
        given = *list;
    }
    if (values) warn_about_count(given.size(), count);
    std::vector<double> all = model.complete_parameters(object, std::move(given));
    const Names names(model, object);
    std::string beyond;
    for (const std::string& assignment : named) {
        const std::size_t equals = assignment.find('=');
        if (equals == std::string::npos)
            return usage_error(fmt::format("--param: `{}` is not of the form NAME=VALUE", assignment)),
                   std::nullopt;
        const auto value = parse_number(std::string_view(assignment).substr(equals + 1));
        if (!value) return usage_error("--param: " + value.error().message), std::nullopt;
        const auto index = names.find(std::string_view(assignment).substr(0, equals));
        if (!index) return std::nullopt;
        if (static_cast<std::size_t>(*index) <= count) {
            all[static_cast<std::size_t>(*index) - 1] = *value;
        } else if (beyond.empty()) {
            beyond = assignment.substr(0, equals);
        }
    }
    if (!beyond.empty())
        print_warning(
            fmt::format("--param {}: the object has {} parameters: the value is ignored", beyond, count));
    return all;
}

std::optional<std::size_t> find_parameter(const Model& model, std::size_t object, std::string_view name) {
    const auto index = Names(model, object).look_up(name);
    if (!index || *index < 1) return std::nullopt;
    return static_cast<std::size_t>(*index);
}

}  // namespace frep::cli
