// Model: a parsed HyperFun or `.vm` file, ready to give the field of any of its objects for any parameter
// values. Tested by tests/unit/lang/model_test.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frep/base/diagnostic.h"
#include "frep/lang/ast.h"
#include "frep/lang/lower.h"

namespace frep {

/// Content of a file that a model names, relative to the model's folder. The library opens no path itself.
using ReadFile = std::function<Result<std::string>(std::string_view)>;

/// The languages that a model may be written in.
enum class ModelText {
    hyperfun,  ///< HyperFun, `.hf`
    vm,        ///< the text form of lang/vm_text.h, `.vm`: one object, without parameters
};

class Model {
  public:
    /// Parses `source`; diagnostics() says what is wrong. `read_file` serves library functions that read a
    /// file; without it they are refused.
    explicit Model(Source source, ReadFile read_file = {}, ModelText text = ModelText::hyperfun);

    /// False when the text has errors; then there are no fields.
    bool ok() const { return !diagnostics_.has_errors(); }
    const Source& source() const { return source_; }
    /// The language of a model that is ok().
    ModelText text_form() const { return field_ ? ModelText::vm : ModelText::hyperfun; }
    const Diagnostics& diagnostics() const { return diagnostics_; }
    const lang::Program& program() const { return *program_; }

    /// Number of the object called `name` (ASCII case folded). An empty name means `my_model` or, without
    /// one, the first object. Nothing when there is no such object.
    std::optional<std::size_t> find_object(std::string_view name) const;
    /// The object's name nearest to a wrong one, for "did you mean"; may be empty.
    std::string_view nearest_object(std::string_view name) const;

    /// Parameter values to use when the caller gives `given`: missing ones take the defaults of `--@ param`
    /// lines (only for the default object), else 0; extra ones are dropped.
    std::vector<double> complete_parameters(std::size_t object, std::vector<double> given) const;

    /// The field of an object with all that the lowering found out. Nothing when an error was added to
    /// `diagnostics`. With `lift`, set operations that the text spells out by sums and roots become
    /// operations (field/lift.h).
    std::optional<lang::Lowered> lower(std::size_t object, const std::vector<double>& parameters,
                                       Diagnostics& diagnostics, bool lift = true) const;

    /// Adds warnings about what `lowered`, a field of this model, does slowly or not as its author may think.
    void advise(const lang::Lowered& lowered, Diagnostics& diagnostics) const;

    /// The field of an object, as find_object() finds it, lifted. Errors: invalid_argument for an unknown
    /// object, invalid_model with the rendered diagnostics.
    Result<Field> field(std::string_view object = {}, std::vector<double> parameters = {}) const;

  private:
    Source source_;
    ReadFile read_file_;
    Diagnostics diagnostics_;
    std::shared_ptr<const lang::Program> program_;
    std::optional<Field> field_;  ///< of a model that needs no lowering
};

}  // namespace frep
