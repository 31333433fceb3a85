// Implementation of pov_isosurface.h: one pass over the graph, arguments before users, then the chain of
// functions that hand shared values on.
#include "frep/lang/pov_isosurface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "frep/lang/pov_operations.h"

namespace frep::lang {

namespace {

constexpr std::size_t text_limit = std::size_t{8} << 20;
constexpr std::size_t value_limit = 50;         ///< of POV-Ray's 56 parameters, three are x, y, z
constexpr double cheap = 64;                    ///< operations that are rather repeated than handed on
constexpr int depth_limit = 24;                 ///< of parentheses in one function
constexpr std::size_t expression_limit = 8000;  ///< bytes

/// A node as text over x, y, z and the values of steps.
struct Expression {
    std::string text;
    std::vector<std::size_t> values;  ///< steps it names, sorted
    int depth = 0;
    double cost = 0;  ///< operations when nothing is shared
};

/// A value that is handed on: v0, v1, ...
struct Step {
    Expression expression;
    std::size_t last_use = 0;  ///< number of the last step, or of the end, that names it
};

class Printer {
  public:
    Printer(const Field& field, const PovIsosurfaceOptions& options)
        : field_(field), graph_(*field.graph), options_(options) {}

    /// Declarations that end with the function Frep_F(x,y,z) in model space.
    Result<std::string> print() {
        const NodeId root = field_.value;
        const std::vector<bool> needed = reachable(graph_, std::span<const NodeId>(&root, 1));
        uses_.assign(root + std::size_t{1}, 0);
        for (NodeId id = 0; id <= root; ++id)
            if (needed[id])
                for (const NodeId argument : graph_.arguments(id)) ++uses_[argument];
        texts_.resize(root + std::size_t{1});
        for (NodeId id = 0; id <= root; ++id) {
            if (!needed[id]) continue;
            auto expression = express(id);
            if (!expression) return expression.error();
            texts_[id] = id == root ? std::move(*expression) : named(id, std::move(*expression));
            written_ += texts_[id].text.size();
            if (written_ > text_limit) return too_long();
        }
        return chain(std::move(texts_[root]));
    }

  private:
    static Error too_long() {
        return {ErrorKind::over_limit, "the function is longer than 8 MiB as text for POV-Ray"};
    }

    Error refused(NodeId id, std::string_view why) const {
        const Span origin = graph_.origin(id);
        std::string place;
        if (options_.source && origin.end > 0)
            place = fmt::format("line {}: ", options_.source->locate(origin.begin).line);
        return {ErrorKind::invalid_argument, fmt::format("{}{}", place, why)};
    }

    Result<Expression> express(NodeId id) {
        const Node& node = graph_.node(id);
        if (node.op == Op::constant) return number(id, graph_.constant_of(id));
        if (node.op == Op::parameter)
            return number(id,
                          node.payload < field_.parameters.size() ? field_.parameters[node.payload] : 0.0);
        if (node.op == Op::coordinate) return coordinate(id, node.payload);
        if (node.op == Op::undefined)
            return refused(id, "a value that is undefined everywhere cannot be written for POV-Ray");
        const std::span<const NodeId> arguments = graph_.arguments(id);
        const bool block = info(node.op).kind == OpKind::block;
        const std::size_t lead = block ? static_cast<std::size_t>(info(node.op).arity) : arguments.size();
        Expression out;
        out.cost = info(node.op).cost;
        std::vector<std::string> texts;
        for (std::size_t i = 0; i < lead; ++i) texts.push_back(take(arguments[i], out));
        std::optional<std::string> text;
        if (block) {
            auto data = block_data(id, arguments.subspan(lead));
            if (!data) return data.error();
            out.cost = info(node.op).cost * static_cast<double>(data->size());
            text = block_call(id, node.op, *data, texts);
        } else {
            text = pov_operation(node.op, texts);
        }
        if (!text)
            return refused(id, fmt::format("POV-Ray has no function for {}; `frep mesh` writes a .pov mesh",
                                           node.op == Op::region
                                               ? "a loop or a search that depends on the point"
                                               : fmt::format("the operation `{}`", info(node.op).name)));
        out.text = std::move(*text);
        ++out.depth;
        return out;
    }

    Result<Expression> number(NodeId id, double value) const {
        if (!std::isfinite(value))
            return refused(id, "a number that is not finite cannot be written for POV-Ray");
        return Expression{pov_number(value), {}, 0, 0};
    }

    Result<Expression> coordinate(NodeId id, std::uint32_t index) const {
        PovCoordinate from{index < 3 ? static_cast<int>(index) : -1, 0};
        if (index < options_.coordinates.size()) from = options_.coordinates[index];
        if (from.axis < 0) return number(id, from.value);
        return Expression{std::string(1, "xyz"[from.axis % 3]), {}, 0, 0};
    }

    /// The text of an argument, with what it costs and names added to `user`.
    std::string take(NodeId argument, Expression& user) {
        Expression& from = texts_[argument];
        user.cost = std::min(user.cost + from.cost, 1e300);
        user.depth = std::max(user.depth, from.depth);
        std::vector<std::size_t> both;
        std::set_union(user.values.begin(), user.values.end(), from.values.begin(), from.values.end(),
                       std::back_inserter(both));
        user.values = std::move(both);
        return from.text;
    }

    /// The data items of a block operation: constants of a block, or arguments that are numbers.
    Result<std::vector<double>> block_data(NodeId id, std::span<const NodeId> items) const {
        const std::span<const double> block = graph_.block_of(id);
        std::vector<double> data(block.begin(), block.end());
        for (const NodeId item : items) {
            const Node& node = graph_.node(item);
            if (node.op == Op::constant) {
                data.push_back(graph_.constant_of(item));
            } else if (node.op == Op::parameter && node.payload < field_.parameters.size()) {
                data.push_back(field_.parameters[node.payload]);
            } else {
                return refused(
                    id, fmt::format("operation `{}`: its table depends on the point, which POV-Ray cannot do",
                                    info(graph_.node(id).op).name));
            }
        }
        for (const double value : data)
            if (!std::isfinite(value))
                return refused(id, "a number that is not finite cannot be written for POV-Ray");
        return data;
    }

    /// The sum as a function of its own, and a call of it.
    std::optional<std::string> block_call(NodeId id, Op op, const std::vector<double>& data,
                                          const std::vector<std::string>& lead) {
        const auto sum = pov_block(op, data);
        if (!sum) return std::nullopt;
        const std::string name = fmt::format("Frep_b{}", id);
        declarations_ += fmt::format("#declare {} = function(px,py,pz{}) {{ {} }}\n", name,
                                     lead.size() > 3 ? ",ps" : "", *sum);
        written_ += sum->size();
        return fmt::format("{}({})", name, fmt::join(lead, ","));
    }

    /// What users of the node write: the expression itself, a call of a function, or a value that is handed
    /// on.
    Expression named(NodeId id, Expression expression) {
        const bool leaf = info(graph_.node(id).op).kind == OpKind::leaf;
        const bool shared = uses_[id] > 1 && !leaf;
        const bool large = expression.depth >= depth_limit || expression.text.size() > expression_limit;
        if (!shared && !large) return expression;
        if (expression.cost <= cheap) {
            declarations_ +=
                fmt::format("#declare Frep_f{} = function(x,y,z) {{ {} }}\n", id, expression.text);
            return {fmt::format("Frep_f{}(x,y,z)", id), {}, 1, expression.cost};
        }
        const std::size_t step = steps_.size();
        const double cost = expression.cost;
        steps_.push_back({std::move(expression), step});
        return {fmt::format("v{}", step), {step}, 0, cost};
    }

    static void append_values(std::string& out, const std::vector<std::size_t>& values) {
        for (const std::size_t v : values) out += fmt::format(",v{}", v);
    }

    /// Frep_g0 computes v0 and calls Frep_g1 with it, and so on; the last one computes F.
    Result<std::string> chain(Expression root) {
        const std::size_t count = steps_.size();
        for (std::size_t i = 0; i < count; ++i)
            for (const std::size_t v : steps_[i].expression.values) steps_[v].last_use = i;
        for (const std::size_t v : root.values) steps_[v].last_use = count;
        // live[i]: values that function i gets
        std::vector<std::vector<std::size_t>> live(count + 1);
        for (std::size_t i = 1; i <= count; ++i) {
            for (const std::size_t v : live[i - 1])
                if (steps_[v].last_use >= i) live[i].push_back(v);
            live[i].push_back(i - 1);
            if (live[i].size() > value_limit)
                return Error{
                    ErrorKind::over_limit,
                    fmt::format(
                        "the function needs more than {} values at once, which POV-Ray cannot hand on",
                        value_limit)};
        }
        std::string out = std::move(declarations_);
        for (std::size_t i = count + 1; i-- > 0;) {
            out += i == 0 ? "#declare Frep_F = function(x,y,z"
                          : fmt::format("#declare Frep_g{} = function(x,y,z", i);
            append_values(out, live[i]);
            out += ") { ";
            if (i == count) {
                out += root.text;
            } else {
                out += fmt::format("Frep_g{}(x,y,z", i + 1);
                for (const std::size_t v : live[i + 1])
                    out += "," + (v == i ? steps_[i].expression.text : fmt::format("v{}", v));
                out += ")";
            }
            out += " }\n";
            if (out.size() > text_limit) return too_long();
        }
        return out;
    }

    const Field& field_;
    const Graph& graph_;
    const PovIsosurfaceOptions& options_;
    std::vector<std::uint32_t> uses_;
    std::vector<Expression> texts_;
    std::vector<Step> steps_;
    std::string declarations_;
    std::size_t written_ = 0;
};

/// A point of model space as POV-Ray's left-handed vector.
std::string vector_text(Vec3 p) { return fmt::format("<{},{},{}>", p.x + 0.0, p.z + 0.0, p.y + 0.0); }

/// A camera that sees the whole box from the front, right and above, and two lights.
std::string stage(const Box3& box) {
    const Vec3 middle = 0.5 * (box.min + box.max), span = box.max - box.min;
    const double size = std::sqrt(dot(span, span));
    return fmt::format(
        "#ifndef (Frep_Include)\n object {{ Frep_Object }}\n"
        " camera {{ perspective location {} look_at {} angle 30 }}\n"
        " light_source {{ {} rgb 1 }}\n light_source {{ {} rgb 0.4 shadowless }}\n"
        " background {{ rgb 1 }}\n#end\n",
        vector_text(middle + size * Vec3{1.0, -1.7, 0.9}), vector_text(middle),
        vector_text(middle + size * Vec3{2, -2, 4}), vector_text(middle + size * Vec3{-3, -2, 1}));
}

}  // namespace

Result<std::string> pov_isosurface(const Field& field, const PovIsosurfaceOptions& options) {
    const auto functions = Printer(field, options).print();
    if (!functions) return functions.error();
    std::string out = "// frep: an isosurface for POV-Ray 3.7 and later\n";
    if (!options.title.empty()) out += "// title: " + escape_controls(to_valid_utf8(options.title)) + "\n";
    out +=
        "// POV-Ray is left-handed: y and z of the model change places. The functions have the model's x, y, "
        "z\n"
        "// and are positive inside; POV-Ray takes negative values for the inside, hence the minus below.\n"
        "// To use the object in another scene: #declare Frep_Include = 1; #include \"this file\"\n"
        "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n";
    out += pov_prelude();
    out += *functions;
    const std::array<double, 3>& c = options.color;
    out += fmt::format(
        "#declare Frep_Object = isosurface {{\n function {{ -Frep_F(x,z,y) }}\n"
        " contained_by {{ box {{ {},{} }} }}\n threshold 0\n max_gradient {}\n accuracy {}\n"
        " pigment {{ srgb <{},{},{}> }}\n finish {{ ambient 0.1 diffuse 0.7 specular 0.3 roughness 0.02 "
        "}}\n}}\n",
        vector_text(options.box.min), vector_text(options.box.max), options.max_gradient,
        1e-4 * length(options.box.max - options.box.min), c[0], c[1], c[2]);
    return out + stage(options.box);
}

}  // namespace frep::lang
