#include "frep/lang/model.h"

#include <algorithm>

#include <fmt/format.h>

#include "frep/lang/parser.h"

namespace frep {
Model::Model(Source source, ReadFile read_file)
    : source_(std::move(source)), read_file_(std::move(read_file)) {
    program_ = std::make_shared<const lang::Program>(lang::parse(source_, diagnostics_));
}

std::optional<std::size_t> Model::find_object(std::string_view name) const {
    const auto& objects = program_->objects;
    const std::string wanted = name.empty() ? "my_model" : lower_case(name);
    const auto found =
        std::find_if(objects.begin(), objects.end(), [&](const lang::Object& o) { return o.name == wanted; });
    if (found != objects.end()) return static_cast<std::size_t>(found - objects.begin());
    if (name.empty() && !objects.empty()) return 0;
    return std::nullopt;
}

std::string_view Model::nearest_object(std::string_view name) const {
    std::vector<std::string_view> names;
    for (const lang::Object& object : program_->objects) names.push_back(object.written_name);
    return nearest_name(name, names);
}

std::vector<double> Model::complete_parameters(std::size_t object, std::vector<double> given) const {
    const std::size_t provided = given.size();
    given.resize(static_cast<std::size_t>(program_->objects[object].parameters()), 0.0);
    if (find_object({}) != object) return given;
    for (const lang::ParameterAnnotation& p : program_->annotations.parameters) {
        const auto i = static_cast<std::size_t>(p.index - 1);
        if (p.has_default && i >= provided && i < given.size()) given[i] = p.value;
    }
    return given;
}

std::optional<lang::Lowered> Model::lower(std::size_t object, const std::vector<double>& parameters,
                                          Diagnostics& diagnostics) const {
    if (!ok()) {
        diagnostics.append(diagnostics_);
        return std::nullopt;
    }
    const lang::LowerOptions options{.parameters = complete_parameters(object, parameters),
                                     .read_file = read_file_};
    return lang::lower(*program_, object, options, diagnostics);
}

Result<Field> Model::field(std::string_view name, std::vector<double> parameters) const {
    if (!ok()) return Error{ErrorKind::invalid_model, render(diagnostics_, source_)};
    const auto object = find_object(name);
    if (!object) return Error{ErrorKind::invalid_argument, fmt::format("the model has no object `{}`", name)};
    Diagnostics found;
    auto lowered = lower(*object, parameters, found);
    if (!lowered) return Error{ErrorKind::invalid_model, render(found, source_)};
    return std::move(lowered->field);
}

}  // namespace frep
