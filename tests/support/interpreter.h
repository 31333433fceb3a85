// A plain interpreter of the syntax tree at one point: the oracle for the lowering. Statements run in order,
// variables are doubles, NaN is undefined. Written for clearness; models whose conditions are undefined are
// outside its scope.
#pragma once

#include <map>
#include <vector>

#include "frep/field/meaning.h"
#include "frep/frep.h"
#include "frep/math/number.h"

namespace frep::test {

class Interpreter {
  public:
    explicit Interpreter(const lang::Program& program) : program_(program) {}

    /// F and the attributes of an object; empty when more than `max_steps` loop steps were taken.
    std::vector<double> run(std::size_t object, std::vector<double> x, std::vector<double> a) {
        std::vector<double> s(static_cast<std::size_t>(program_.objects[object].attributes()), 0.0);
        const double value = call(object, std::move(x), std::move(a), s);
        std::vector<double> out{value};
        out.insert(out.end(), s.begin(), s.end());
        return out;
    }

  private:
    struct Frame {
        const lang::Object* object;
        std::vector<double> scalars;
        std::vector<std::vector<double>> arrays;
        double result = __builtin_nan("");
    };

    double call(std::size_t index, std::vector<double> x, std::vector<double> a, std::vector<double>& s) {
        const lang::Object& object = program_.objects[index];
        Frame frame{&object, std::vector<double>(object.scalars.size(), __builtin_nan("")), {}};
        for (const auto& array : object.arrays) frame.arrays.emplace_back(array.size, __builtin_nan(""));
        x.resize(frame.arrays[0].size(), 0.0);
        a.resize(frame.arrays[1].size(), 0.0);
        frame.arrays[0] = std::move(x);
        frame.arrays[1] = std::move(a);
        frame.arrays[2] = s;
        execute(frame, object.body);
        s = frame.arrays[2];
        return frame.result;
    }

    void execute(Frame& frame, const std::vector<lang::StatementId>& list) {
        for (auto id : list) execute(frame, program_.statements[id]);
    }

    void execute(Frame& frame, const lang::StatementNode& s) {
        using lang::StatementKind;
        switch (s.kind) {
            case StatementKind::assign:
                frame.scalars[s.symbol] = evaluate(frame, s.value);
                break;
            case StatementKind::result:
                frame.result = evaluate(frame, s.value);
                break;
            case StatementKind::assign_list:
                for (std::size_t i = s.list.size(); i-- > 0;)
                    frame.arrays[s.symbol][i] = evaluate(frame, s.list[i]);
                break;
            case StatementKind::assign_item: {
                const double value = evaluate(frame, s.value);
                const double index = math::round_half_up(evaluate(frame, s.index));
                auto& array = frame.arrays[s.symbol];
                if (index >= 1 && index <= static_cast<double>(array.size()))
                    array[static_cast<std::size_t>(index) - 1] = value;
                else
                    array.assign(array.size(), __builtin_nan(""));
                break;
            }
            case StatementKind::branch:
                execute(frame, is_true(evaluate(frame, s.value)) ? s.first : s.second);
                break;
            case StatementKind::loop:
                while (is_true(evaluate(frame, s.value))) execute(frame, s.first);
                break;
        }
    }

    static bool is_true(double value) { return value >= 1e-6 || value <= -1e-6; }

    double apply(Op op, std::initializer_list<double> args) {
        return meaning<double>(op, std::span<const double>(args.begin(), args.size()), {});
    }

    double combine(lang::Operator op, double a, double b) {
        using lang::Operator;
        switch (op) {
            case Operator::add:
                return a + b;
            case Operator::subtract:
                return a - b;
            case Operator::unite:
                return apply(Op::r_or, {a, b});
            case Operator::intersect:
            case Operator::product:
                return apply(Op::r_and, {a, b});
            case Operator::subtract_solid:
                return apply(Op::r_and, {a, -b});
            case Operator::multiply:
                return a * b;
            case Operator::divide:
                return a / b;
            case Operator::power:
                return apply(Op::pow, {a, b});
            case Operator::less:
                return a < b;
            case Operator::less_equal:
                return a <= b;
            case Operator::greater:
                return a > b;
            case Operator::greater_equal:
                return a >= b;
            case Operator::equal:
                return apply(Op::equal, {a, b});
            case Operator::not_equal:
                return 1 - apply(Op::equal, {a, b});
            case Operator::logical_and:
                return is_true(a) && is_true(b);
            case Operator::logical_or:
                return is_true(a) || is_true(b);
            default:
                return a;
        }
    }

    double evaluate(Frame& frame, lang::ExpressionId id) {
        using lang::ExpressionKind;
        const lang::ExpressionNode& e = program_.expressions[id];
        switch (e.kind) {
            case ExpressionKind::number:
                return e.value;
            case ExpressionKind::scalar:
                return frame.scalars[e.symbol];
            case ExpressionKind::item: {
                const double index = math::round_half_up(evaluate(frame, e.operands[0]));
                const auto& array = frame.arrays[e.symbol];
                const bool inside = index >= 1 && index <= static_cast<double>(array.size());
                return inside ? array[static_cast<std::size_t>(index) - 1] : __builtin_nan("");
            }
            case ExpressionKind::unary: {
                const double a = evaluate(frame, e.operands[0]);
                if (e.operators[0] == lang::Operator::plus) return a;
                return e.operators[0] == lang::Operator::logical_not ? !is_true(a) : -a;
            }
            case ExpressionKind::chain:
                return chain(frame, e);
            case ExpressionKind::builtin:
                return builtin(frame, e);
            case ExpressionKind::library_call:
                return library(frame, e);
            case ExpressionKind::object_call:
                return object(frame, e);
            default:
                return __builtin_nan("");
        }
    }

    std::vector<double> operands(Frame& frame, const lang::ExpressionNode& e) {
        std::vector<double> values(e.operands.size());
        for (std::size_t i = values.size(); i-- > 0;) values[i] = evaluate(frame, e.operands[i]);
        return values;
    }

    double chain(Frame& frame, const lang::ExpressionNode& e) {
        const auto values = operands(frame, e);
        double out = values[0];
        for (std::size_t i = 0; i < e.operators.size(); ++i)
            out = combine(e.operators[i], out, values[i + 1]);
        return out;
    }

    double builtin(Frame& frame, const lang::ExpressionNode& e) {
        const auto v = operands(frame, e);
        switch (e.builtin) {
            case lang::Builtin::sin:
                return math::sin(v[0]);
            case lang::Builtin::cos:
                return math::cos(v[0]);
            case lang::Builtin::abs:
                return math::abs(v[0]);
            case lang::Builtin::sqrt:
                return math::sqrt(v[0]);
            case lang::Builtin::min:
                return math::min(v[0], v[1]);
            case lang::Builtin::max:
                return math::max(v[0], v[1]);
            case lang::Builtin::floor:
                return math::floor(v[0]);
            default:
                return __builtin_nan("");
        }
    }

    double object(Frame& frame, const lang::ExpressionNode& e) {
        auto symbol = [&](std::size_t i) { return program_.expressions[e.operands[i]].symbol; };
        const bool passes = e.operands.size() == 3;
        const auto size = static_cast<std::size_t>(program_.objects[e.symbol].attributes());
        std::vector<double> s = passes ? frame.arrays[symbol(2)] : std::vector<double>(size, 0.0);
        const double value = call(e.symbol, frame.arrays[symbol(0)], frame.arrays[symbol(1)], s);
        if (passes)
            frame.arrays[symbol(2)] = s;
        else if (frame.arrays[2].size() == 1)
            frame.arrays[2] = s;
        return value;
    }

    /// Library calls through a graph of constants: the builder's own meaning at this point.
    double library(Frame& frame, const lang::ExpressionNode& e) {
        Graph graph;
        shapes::Build build{graph, {}, {}};
        std::vector<shapes::ArgumentValue> values(e.operands.size());
        for (std::size_t i = values.size(); i-- > 0;)
            if (e.function->arguments[i].kind == shapes::ArgumentKind::number)
                values[i].number = build.constant(evaluate(frame, e.operands[i]));
        for (std::size_t i = 0; i < values.size(); ++i)
            if (e.function->arguments[i].kind != shapes::ArgumentKind::number)
                for (double item : frame.arrays[program_.expressions[e.operands[i]].symbol])
                    values[i].items.push_back(build.constant(item));
        const NodeId result = e.function->invoke(build, values).id();
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (e.function->arguments[i].kind != shapes::ArgumentKind::array_in_out) continue;
            auto& array = frame.arrays[program_.expressions[e.operands[i]].symbol];
            for (std::size_t k = 0; k < array.size(); ++k)
                array[k] = graph.constant_value(values[i].items[k].id()).value();
        }
        return graph.constant_value(result).value();
    }

    const lang::Program& program_;
};

}  // namespace frep::test
