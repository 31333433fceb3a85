// Tests of lang/pov_isosurface.h: the text is read by a small evaluator of POV-Ray's functions and compared
// with the engine at random points; operations that POV-Ray cannot do are refused by name and place.
#include "frep/lang/pov_isosurface.h"

#include <doctest/doctest.h>

#include <charconv>
#include <cmath>
#include <map>

#include "frep/frep.h"

using namespace frep;

namespace {

/// The functions that a text declares, evaluated by walking their text.
class PovFunctions {
  public:
    explicit PovFunctions(std::string_view text) {
        const std::string_view mark = "#declare ";
        for (std::size_t at = text.find(mark); at != std::string_view::npos; at = text.find(mark, at + 1)) {
            const std::size_t equals = text.find(" = function(", at);
            if (equals == std::string_view::npos ||
                text.substr(at, equals - at).find('\n') != std::string_view::npos)
                continue;
            Function f;
            const std::size_t open = equals + 12, close = text.find(')', open);
            std::string name;
            for (std::size_t i = open; i <= close; ++i) {
                if (text[i] == ',' || text[i] == ')') {
                    f.parameters.push_back(name);
                    name.clear();
                } else {
                    name += text[i];
                }
            }
            const std::size_t begin = text.find('{', close) + 1, end = text.find('}', begin);
            f.body = text.substr(begin, end - begin);
            functions_[std::string(text.substr(at + mark.size(), equals - at - mark.size()))] = f;
            most_parameters = std::max(most_parameters, f.parameters.size());
        }
    }

    double call(const std::string& name, const std::vector<double>& values) const {
        const Function& f = functions_.at(name);
        REQUIRE(f.parameters.size() == values.size());
        Frame frame{f.body, 0, {}};
        for (std::size_t i = 0; i < values.size(); ++i) frame.values[f.parameters[i]] = values[i];
        const double value = sum(frame);
        REQUIRE(peek(frame) == '\0');
        return value;
    }

    std::size_t most_parameters = 0;
    std::size_t count() const { return functions_.size(); }

  private:
    struct Function {
        std::vector<std::string> parameters;
        std::string_view body;
    };
    struct Frame {
        std::string_view text;
        std::size_t at;
        std::map<std::string, double, std::less<>> values;
    };

    static char peek(Frame& f) {
        while (f.at < f.text.size() && std::isspace(static_cast<unsigned char>(f.text[f.at]))) ++f.at;
        return f.at < f.text.size() ? f.text[f.at] : '\0';
    }
    static void expect(Frame& f, char c) {
        REQUIRE(peek(f) == c);
        ++f.at;
    }
    double sum(Frame& f) const {
        double value = product(f);
        while (peek(f) == '+' || peek(f) == '-') {
            const bool plus = f.text[f.at++] == '+';
            const double next = product(f);
            value = plus ? value + next : value - next;
        }
        return value;
    }
    double product(Frame& f) const {
        double value = factor(f);
        while (peek(f) == '*' || peek(f) == '/') {
            const bool times = f.text[f.at++] == '*';
            const double next = factor(f);
            value = times ? value * next : value / next;
        }
        return value;
    }
    double factor(Frame& f) const {
        const char c = peek(f);
        if (c == '-') {
            ++f.at;
            return -factor(f);
        }
        if (c == '(') {
            ++f.at;
            const double value = sum(f);
            expect(f, ')');
            return value;
        }
        if (std::isdigit(static_cast<unsigned char>(c))) {
            double value = 0;
            const auto end = std::from_chars(f.text.data() + f.at, f.text.data() + f.text.size(), value);
            f.at = static_cast<std::size_t>(end.ptr - f.text.data());
            return value;
        }
        std::string name;
        while (f.at < f.text.size() &&
               (std::isalnum(static_cast<unsigned char>(f.text[f.at])) || f.text[f.at] == '_'))
            name += f.text[f.at++];
        REQUIRE_FALSE(name.empty());
        if (peek(f) != '(') {
            REQUIRE(f.values.contains(name));
            return f.values.find(name)->second;
        }
        std::vector<double> values;
        do {
            ++f.at;
            values.push_back(sum(f));
        } while (peek(f) == ',');
        expect(f, ')');
        return functions_.contains(name) ? call(name, values) : built_in(name, values);
    }
    /// POV-Ray 3.7 reference, 3.3.1.8.3.
    static double built_in(const std::string& name, const std::vector<double>& v) {
        if (name == "select") return v[0] < 0 ? v[1] : (v.size() == 3 || v[0] == 0 ? v[2] : v.at(3));
        if (name == "min") return v.at(0) < v.at(1) ? v[0] : v[1];
        if (name == "max") return v.at(0) > v.at(1) ? v[0] : v[1];
        if (name == "pow") return std::pow(v.at(0), v.at(1));
        if (name == "mod") return std::fmod(v.at(0), v.at(1));
        if (name == "atan2") return std::atan2(v.at(0), v.at(1));
        REQUIRE(v.size() == 1);
        const std::map<std::string, double (*)(double)> known{
            {"sqrt", std::sqrt}, {"abs", std::fabs},  {"floor", std::floor}, {"ceil", std::ceil},
            {"int", std::trunc}, {"exp", std::exp},   {"ln", std::log},      {"log", std::log10},
            {"sin", std::sin},   {"cos", std::cos},   {"tan", std::tan},     {"asin", std::asin},
            {"acos", std::acos}, {"atan", std::atan}, {"sinh", std::sinh},   {"cosh", std::cosh},
            {"tanh", std::tanh}};
        REQUIRE(known.contains(name));
        return known.at(name)(v[0]);
    }

    std::map<std::string, Function> functions_;
};

struct Compiled {
    Model model;
    Field field;
    std::string text;
};

Compiled compiled(const std::string& body, const std::string& header = "my_model(x[3], a[1])") {
    auto model = compile(header + "\n{\n" + body + "\n}\n");
    if (!model) FAIL(model.error().message);
    auto field = model->field();
    if (!field) FAIL(field.error().message);
    const auto text = lang::pov_isosurface(*field, {});
    if (!text) FAIL(text.error().message);
    return {*model, *field, *text};
}

/// Compares the text's Frep_F with the engine at 200 points of the cube of half side 2.
void check_same(const Compiled& one) {
    const PovFunctions functions(one.text);
    auto evaluator = make_evaluator(one.field, {});
    REQUIRE(bool(evaluator));
    std::uint32_t state = 12345;
    const auto random = [&state] {
        state = state * 1664525u + 1013904223u;
        return static_cast<double>(state >> 8) / (1 << 24) * 4 - 2;
    };
    for (int i = 0; i < 200; ++i) {
        const double p[3] = {random(), random(), random()};
        const std::vector<const double*> coordinates{&p[0], &p[1], &p[2]};
        double value = 0;
        double* out = &value;
        (*evaluator)->values(coordinates, 1, std::span<double* const>(&out, 1));
        if (value != value) continue;
        CAPTURE(i);
        CHECK(functions.call("Frep_F", {p[0], p[1], p[2]}) == doctest::Approx(value).epsilon(1e-9));
    }
}

std::string refusal(const std::string& body) {
    auto model = compile("my_model(x[3], a[1])\n{\n" + body + "\n}\n");
    REQUIRE(bool(model));
    auto field = model->field();
    REQUIRE(bool(field));
    const auto text =
        lang::pov_isosurface(*field, {.coordinates = {}, .title = {}, .source = &model->source()});
    REQUIRE_FALSE(bool(text));
    CHECK(text.error().kind == ErrorKind::invalid_argument);
    return text.error().message;
}

}  // namespace

TEST_CASE("POV-Ray: arithmetic and elementary functions have the engine's values") {
    check_same(compiled("my_model = 1 - x[1]^2 - x[2]*x[3] + 2/(3 + x[2]^2) - (-0.5)*x[3];"));
    check_same(compiled(
        "my_model = sin(x[1]) + cos(x[2])*exp(x[3]) - atan(x[1]*x[2]) + abs(x[3]) + sqrt(x[1]^2 + 1);"));
    check_same(
        compiled("my_model = log(4 + x[1]) + tan(x[2]/2) + atan2(x[1], x[2]) + sinh(x[3]) - tanh(x[1]) + "
                 "acos(x[1]/3) + asin(x[2]/3);"));
    check_same(
        compiled("my_model = min(x[1], x[2]) - max(x[2], x[3]) + x[1]^3 + mod(x[1], 0.7) + floor(x[2]*3);"));
}

TEST_CASE("POV-Ray: set operations, branches and truth") {
    check_same(compiled(
        "a1 = 1 - x[1]^2; b = x[2] - x[3]; c = 0.5 - x[2]^2;\nmy_model = ((a1 & b) | c) \\ (x[1] - 0.5);"));
    check_same(compiled("if (x[1] > 0.3) then v = x[2]; else v = x[3] - 2; endif;\nmy_model = v;"));
    check_same(
        compiled("u = 0; if ((x[1] <= x[2]) and (not (x[2] > x[3]))) then u = 1; endif;\nw = 0; if ((x[1] < "
                 "0) or (x[2] = x[3])) then w = 2; endif;\nmy_model = u + w - 1.5;"));
}

TEST_CASE("POV-Ray: blends") {
    const std::string parts =
        "f1 = 1 - x[1]^2 - x[2]^2; f2 = 0.5 - x[2]^2 - x[3]^2; f3 = 1.5 - x[1]^2 - x[3]^2;\n";
    check_same(compiled(parts + "my_model = hfBlendUni(f1, f2, 0.3, 0.4, 0.5);"));
    check_same(compiled(parts + "my_model = hfBlendInt(f1, f2, 0.3, 0.4, 0.5);"));
    check_same(compiled(parts + "my_model = hfBlendUni(f1, f2, 0.3, 0, 0.5);"));
    check_same(compiled(parts + "my_model = hfBoundedBlendUni(f1, f2, f3, 0.3, 0.4, 0.5, 0.6);"));
    check_same(compiled(parts + "my_model = hfBoundedBlendInt(f1, f2, f3, 0.3, 0.4, 0.5, 0.6);"));
}

TEST_CASE("POV-Ray: sums over points and segments") {
    const std::string points =
        "array px[2], py[2], pz[2], p[2], q[2];\npx = [-0.7, 0.7]; py = [0, 0.1]; pz = [0, -0.5]; p = [2, "
        "4]; q = [1, 1.5];\n";
    check_same(compiled(points + "my_model = hfBlobby(x, px, py, pz, p, q, 0.4);"));
    check_same(compiled(points + "my_model = hfMetaball(x, px, py, pz, p, q, 0.25);"));
    check_same(compiled(points + "my_model = hfSoft(x, px, py, pz, q, 0.3);"));
    check_same(
        compiled("array b[6], e[6], k[2];\nb = [-0.8, -0.6, 0, 0.1, 0.2, 0.3]; e = [0.8, -0.6, 0, 1, 1, 1]; "
                 "k = [1, 2];\n"
                 "my_model = hfConvLine(x, b, e, k, 0.3);"));
}

TEST_CASE("POV-Ray: shared values are computed once, whatever the depth") {
    // ten levels, each of which reads the one below four times: 4^10 operations if it were written out
    std::string body =
        "array u[3], w[3]; u[1] = x[1]; u[2] = x[2]; u[3] = x[3]; i = 1;\n"
        "while (i < 11) loop\n"
        "  w[1] = sin(u[1] + u[2]*u[3]); w[2] = cos(u[2] - u[3]*u[1]); w[3] = (u[1] + u[2] + u[3])/2;\n"
        "  u[1] = w[1]; u[2] = w[2]; u[3] = w[3]; i = i + 1;\n"
        "endloop;\n"
        "my_model = u[1] + u[2] + u[3];";
    const Compiled one = compiled(body);
    CHECK(one.text.size() < 20000);
    const PovFunctions functions(one.text);
    CHECK(functions.most_parameters <= 56);
    check_same(one);
}

TEST_CASE("POV-Ray: a long union does not nest deeply") {
    std::string body = "my_model = 1 - x[1]^2";
    for (int i = 0; i < 300; ++i)
        body +=
            " | (0.01 - (x[1] - " + std::to_string(i % 7) + ")^2 - (x[2] - 0." + std::to_string(i) + ")^2)";
    const Compiled one = compiled(body + ";");
    int depth = 0, most = 0;
    for (const char c : one.text) {
        depth += c == '(' ? 1 : (c == ')' ? -1 : 0);
        most = std::max(most, depth);
    }
    CHECK(most < 80);
    check_same(one);
}

TEST_CASE("POV-Ray: the sample pot") {
    auto model = compile_file(std::string(FREP_SOURCE_DIR) + "/examples/sake-pot.hf");
    REQUIRE(bool(model));
    auto field = model->field();
    REQUIRE(bool(field));
    const auto text =
        lang::pov_isosurface(*field, {.coordinates = {}, .title = "pot\n#declare x = 1;", .source = nullptr});
    REQUIRE(bool(text));
    CHECK(text->find("\n#declare x") == std::string::npos);  // a title ends no comment
    check_same({*model, *field, *text});
}

TEST_CASE("POV-Ray: axes, box and sign") {
    const Compiled one = compiled("my_model = x[1] + 10*x[2] + 100*x[3];");
    const auto text = lang::pov_isosurface(one.field, {.box = {{1, 2, 3}, {4, 5, 6}},
                                                       .max_gradient = 7,
                                                       .coordinates = {{2, 0}, {-1, 5}, {0, 0}},
                                                       .title = {}});
    REQUIRE(bool(text));
    CHECK(text->find("function { -Frep_F(x,z,y) }") != std::string::npos);
    CHECK(text->find("box { <1,3,2>,<4,6,5> }") != std::string::npos);
    CHECK(text->find("max_gradient 7\n") != std::string::npos);
    CHECK(PovFunctions(*text).call("Frep_F", {1, 2, 3}) == 3 + 50 + 100);
}

TEST_CASE("POV-Ray: what it cannot do is refused by name and place") {
    CHECK(refusal("my_model = x[1]\n + hfA_NoiseP(x);").find("line 4: ") == 0);
    const std::string message =
        refusal("array c[3]; c = [0, 0, 0];\nmy_model = hfDEllipsoid(x, c, 1, 2, 3);");
    CHECK(message.find("ellipsoid_distance") != std::string::npos);
    CHECK(message.find("frep mesh") != std::string::npos);
}
