#include "frep/lang/model.h"

#include <algorithm>

#include <fmt/format.h>

#include "frep/field/value_folds.h"
#include "frep/lang/parser.h"
#include "frep/lang/vm_text.h"

namespace frep {
namespace {

/// What a HyperFun file with the one object `my_model` and no parameters would say.
lang::Program program_of(const Field& field) {
    lang::Object object;
    object.name = object.written_name = "my_model";
    object.arrays = {{"x", static_cast<std::uint32_t>(field.coordinates), {}}, {"a", 0, {}}, {"s", 0, {}}};
    lang::Program program;
    program.objects.push_back(std::move(object));
    return program;
}

}  // namespace

Model::Model(Source source, ReadFile read_file, ModelText text)
    : source_(std::move(source)), read_file_(std::move(read_file)) {
    if (text == ModelText::hyperfun) {
        program_ = std::make_shared<const lang::Program>(lang::parse(source_, diagnostics_));
        return;
    }
    lang::Reporter report(source_);
    field_ = lang::parse_vm_text(source_, report);
    report.finish(diagnostics_);
    program_ = std::make_shared<const lang::Program>(field_ ? program_of(*field_) : lang::Program{});
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
                                          Diagnostics& diagnostics, bool lift) const {
    if (!ok()) {
        diagnostics.append(diagnostics_);
        return std::nullopt;
    }
    std::optional<lang::Lowered> out;
    if (field_) {
        out.emplace();
        out->field = *field_;
        out->operations_before = field_->graph->size();
    } else {
        const lang::LowerOptions options{.parameters = complete_parameters(object, parameters),
                                         .read_file = read_file_};
        out = lang::lower(*program_, object, options, diagnostics);
    }
    if (out && lift) out->field = lift_r_functions(out->field, &out->lifted);
    return out;
}

void Model::advise(const lang::Lowered& lowered, Diagnostics& diagnostics) const {
    constexpr std::size_t long_fold = 5;
    lang::Reporter report(source_);
    for (const ValueFold& fold : value_folds(lowered.field, long_fold))
        report.warning(
            lang::Code::r_fold_values, lowered.field.graph->origin(fold.node),
            {fmt::format("{} solids are joined by set operations, and then calculated with", fold.operands),
             "values bend here with every operand",
             "blend or offset the parts concerned and join the results, or join by min and max"});
    report.finish(diagnostics);
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
