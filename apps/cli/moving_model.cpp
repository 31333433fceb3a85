// Implementation of moving_model.h.
#include "moving_model.h"

#include <cmath>

#include <fmt/format.h>

#include "parameters.h"
#include "terminal.h"
#include "values.h"

namespace frep::cli {

namespace {

Error usage(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }

/// All names that something of the model could be moved by.
std::string names_of(const PreparedModel& prepared) {
    std::string out;
    for (std::size_t i = 0; i < prepared.map.coordinates.size(); ++i)
        if (!prepared.map_given || prepared.map.coordinates[i].axis < 0)
            out += (out.empty() ? "" : ", ") + coordinate_name(i);
    for (const auto& parameter : prepared.model.program().annotations.parameters)
        out += (out.empty() ? "" : ", ") + parameter.name;
    return out;
}

/// NAME and the numbers behind the equals sign.
Result<Along> along_of(std::string_view text, std::string_view name, std::string_view from,
                       std::string_view to) {
    const auto first = parse_number(from), last = parse_number(to);
    if (!first) return first.error();
    if (!last) return last.error();
    if (!std::isfinite(*first) || !std::isfinite(*last) || *first == *last)
        return usage(fmt::format("`{}` must run between two different finite numbers", text));
    return Along{std::string(name), *first, *last};
}

}  // namespace

Result<Along> parse_along(std::string_view text) {
    const std::size_t equals = text.find('='), dots = text.find("..");
    if (equals == 0 || equals == text.npos || dots == text.npos || dots < equals)
        return usage(fmt::format("`{}` is not of the form NAME=A..B, as in t=-10..10", text));
    return along_of(text, text.substr(0, equals), text.substr(equals + 1, dots - equals - 1),
                    text.substr(dots + 2));
}

Result<Steps> parse_steps(std::string_view text, int most) {
    const std::size_t equals = text.find('='), first = text.find(':'), second = text.rfind(':');
    if (equals == 0 || equals == text.npos || first == text.npos || first < equals || first == second)
        return usage(fmt::format("`{}` is not of the form NAME=A:B:N, as in t=-10:10:5", text));
    auto along = along_of(text, text.substr(0, equals), text.substr(equals + 1, first - equals - 1),
                          text.substr(first + 1, second - first - 1));
    if (!along) return along.error();
    const auto count = parse_integer(text.substr(second + 1), 2, most);
    if (!count) return count.error();
    return Steps{std::move(*along), static_cast<int>(*count)};
}

std::vector<double> evenly_spaced(const Along& along, int count) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i) out.push_back(along.from + (along.to - along.from) * i / (count - 1));
    return out;
}

Result<MovingModel> MovingModel::make(PreparedModel& prepared, const std::optional<Along>& along) {
    MovingModel out(prepared);
    if (!along) return out;
    const std::string name = lower_case(along->name);
    const auto count = prepared.map.coordinates.size();
    const auto index = find_parameter(prepared.model, prepared.object, name);
    const bool is_parameter = index && *index <= prepared.field().parameters.size();
    auto coordinate = find_coordinate(name, count);
    if (!coordinate && !is_parameter) coordinate = find_time(name, count);
    if (coordinate) {
        if (prepared.map_given && prepared.map.coordinates[*coordinate].axis >= 0)
            return usage(fmt::format("coordinate {} is an axis of the picture (--map)", along->name));
        out.coordinate_ = coordinate;
        out.name_ = coordinate_name(*coordinate);
        return out;
    }
    if (is_parameter) {
        out.parameter_ = *index - 1;
        out.name_ = along->name;
        return out;
    }
    const std::string known = names_of(prepared);
    return usage(fmt::format("the object has no coordinate or parameter `{}`{}", along->name,
                             known.empty() ? "" : "; there are " + known));
}

Status MovingModel::set(double value) {
    PreparedModel& p = *prepared_;
    if (coordinate_) {
        p.map.coordinates[*coordinate_] = {.axis = -1, .value = value};
        return {};
    }
    if (!parameter_) return {};
    for (const auto& [coordinate, parameter] : p.tied)
        if (parameter == *parameter_) p.map.coordinates[coordinate].value = value;
    std::vector<double> values = p.field().parameters;
    values[*parameter_] = value;
    if (*parameter_ < p.lowered.structural.size() && !p.lowered.structural[*parameter_]) {
        p.lowered.field.parameters = std::move(values);
        return {};
    }
    Diagnostics found;
    auto lowered = p.model.lower(p.object, values, found);
    if (!lowered) {
        print_diagnostics(found, p.model.source());
        return Error{ErrorKind::invalid_model,
                     fmt::format("the model cannot be evaluated with {} = {}", name_, number_text(value))};
    }
    p.lowered = std::move(*lowered);
    return {};
}

Result<std::unique_ptr<SampledField>> MovingModel::field(double iso, bool attributes) const {
    return sampled_field(*prepared_, iso, attributes);
}

}  // namespace frep::cli
