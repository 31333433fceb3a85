// The FRep library: every function of HyperFun and the project's own, in one table. From it come the HyperFun
// names, arities and argument kinds, docs/library.md, `frep info --library` and the diagnostics of wrong
// calls. Each function is a C++ builder: it makes nodes of a graph from nodes. A row of the table binds a
// builder; kinds of arguments follow from the builder's signature (see binding.h), so that the two cannot
// disagree. Tested by tests/unit/shapes/.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frep/base/result.h"
#include "frep/field/expression.h"

namespace frep::shapes {

/// Items of an array argument that is only read, and of one that the function changes in place.
using Array = std::span<const Expression>;
using ArrayInOut = std::span<Expression>;

/// What the old library answers for wrong array sizes and degenerate parameters.
inline constexpr double error_value = -1111111111111.0;

/// A system of R-functions: what the operators | & \ @ of a file mean.
struct SetSystem {
    enum class Kind : unsigned char { r0, min_max, r_alpha, r0m, rp };
    Kind kind = Kind::r0;
    double parameter = 0;  ///< alpha in (-1, 1], m >= 0, or p > 1
    bool operator==(const SetSystem&) const = default;
};

/// What a builder gets from its caller beside its arguments.
struct Build {
    Graph& graph;
    /// Told of wrong array sizes and degenerate constants: one sentence, shown as a warning at the call.
    std::function<void(const std::string&)> warn;
    /// The outside world: content of a file named relative to the model's folder. Empty where there is none.
    std::function<Result<std::string>(std::string_view)> read_file;
    /// Told of every expression whose present number decides the shape of the graph (a size, a count).
    std::function<void(Expression)> decides = {};
    /// The file's operators, for functions that stand for several of them.
    SetSystem set_system = {};

    /// Told why a file that the call names cannot serve, and what of a file was left out: one sentence, shown
    /// as an error or a warning at the call.
    std::function<void(const std::string&)> refuse = {};
    std::function<void(const std::string&)> left_out = {};
    /// Told of a search that has no meaning: one sentence, shown as an error at the call.
    std::function<void(const std::string&)> refuse_search = {};

    Expression constant(double value) const { return {graph, graph.constant(value)}; }
    Expression error(const std::string& message) const {
        if (warn) warn(message);
        return constant(error_value);
    }
    Expression no_search(const std::string& message) const {
        if (refuse_search) {
            refuse_search(message);
            return constant(error_value);
        }
        return error(message);
    }
    Expression refused(const std::string& message) const {
        if (refuse) refuse(message);
        return constant(error_value);
    }
};

enum class ArgumentKind : unsigned char { number, array, array_in_out, text };

struct ArgumentInfo {
    std::string_view name;
    ArgumentKind kind;
};

/// A value for one argument: `number` for numbers, `items` for arrays (changed in place for array_in_out),
/// `text`.
struct ArgumentValue {
    Expression number;
    std::vector<Expression> items;
    std::string_view text;
};

/// A row of the library table. Functions with several argument lists have several adjacent rows of one name.
struct LibraryFunction {
    std::string_view name;                ///< HyperFun name, as documented: hfSphere
    std::string_view group;               ///< "Primitives", "Blends", ...
    std::vector<ArgumentInfo> arguments;  ///< in order
    Expression (*invoke)(Build&, std::span<ArgumentValue>);
    std::string_view doc;       ///< one line: what it makes
    std::string_view formula;   ///< value or effect, in the notation of docs/library.md
    std::string_view citation;  ///< key of docs/bibliography.md, may be empty
    std::string_view note;      ///< a surprise that is kept for old files, may be empty
    bool reserved;              ///< a name of the old library; new names may be shadowed by the model's own
};

/// All rows, grouped, in the order of the documentation.
std::span<const LibraryFunction> library();

/// The rows of that name (ASCII case folded); empty when there is none.
std::span<const LibraryFunction> find_functions(std::string_view name);

}  // namespace frep::shapes
