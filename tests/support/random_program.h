// Random HyperFun programs with loops that depend on the point, branches, arrays, in-place transforms and
// calls. Every loop ends: its condition counts a step variable of its own. Counter-based and seeded.
#pragma once

#include <cstdint>
#include <string>

#include <fmt/format.h>

namespace frep::test {

class RandomProgram {
  public:
    explicit RandomProgram(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 12345) {}

    std::string text() {
        std::string out;
        objects_ = 0;
        const int count = 1 + pick(3);
        for (int i = 0; i + 1 < count; ++i) {
            out += object(fmt::format("part{}", i));
            ++objects_;
        }
        return out + object("my_model");
    }

    /// A whole number in 0..n-1, and a number of moderate size.
    int pick(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
    double number() { return static_cast<double>(pick(33) - 16) / 8.0; }

  private:
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }

    std::string object(const std::string& name) {
        loops_ = 0;
        std::string out = name + "(x[3], a[2], s[2])\n{\n  array p[3], q[4];\n";
        out += "  u = x[1]; v = x[2]; w = 0.5; p = [1, 2, 3]; q = [0.5, -1, 2, 0];\n  p[1] = x[3];\n";
        const int count = 2 + pick(5);
        for (int i = 0; i < count; ++i) out += statement(2, "  ");
        return out + fmt::format("  s[1] = {};\n  {} = {};\n}}\n", expression(1), name, expression(2));
    }

    std::string variable() {
        static const char* const names[] = {"u", "v", "w"};
        return names[pick(3)];
    }

    std::string index(int size) {
        if (pick(2)) return std::to_string(1 + pick(size));
        return fmt::format("(1 + {}*abs(sin({})))", size - 1, variable());
    }

    std::string item() {
        switch (pick(5)) {
            case 0:
                return fmt::format("p[{}]", index(3));
            case 1:
                return fmt::format("q[{}]", index(4));
            case 2:
                return fmt::format("x[{}]", 1 + pick(3));
            case 3:
                return fmt::format("a[{}]", 1 + pick(2));
            default:
                return fmt::format("s[{}]", 1 + pick(2));
        }
    }

    std::string leaf() {
        const int kind = pick(5);
        if (kind == 0) return fmt::format("({})", number());
        return kind == 1 ? item() : variable();
    }

    std::string expression(int depth) {
        if (depth == 0) return leaf();
        switch (pick(11)) {
            case 0:
                return fmt::format("({} + {})", expression(depth - 1), expression(depth - 1));
            case 1:
                return fmt::format("({} - {} - {})", expression(depth - 1), leaf(), expression(depth - 1));
            case 2:
                return fmt::format("({} * 0.5)", expression(depth - 1));
            case 3:
                return fmt::format("sin({})", expression(depth - 1));
            case 4:
                return fmt::format("({} | {})", expression(depth - 1), leaf());
            case 5:
                return fmt::format("({} & {})", leaf(), expression(depth - 1));
            case 6:
                return fmt::format("min({}, {})", expression(depth - 1), leaf());
            case 7:
                return fmt::format("({} + 0*hfShift3D({}, {}, 0.25, 0) + {})", leaf(), array3(), leaf(),
                                   item());
            case 8:
                return fmt::format("abs({})", expression(depth - 1));
            case 9:
                if (objects_ > 0) return fmt::format("({} + 0.5*sin({}) + {})", leaf(), call(), leaf());
                return leaf();
            default:
                return leaf();
        }
    }

    std::string array3() { return pick(2) ? "p" : "x"; }

    std::string call() { return fmt::format("part{}({}, a, s)", pick(objects_), array3()); }

    std::string condition() {
        switch (pick(4)) {
            case 0:
                return fmt::format("{} > {}", variable(), number());
            case 1:
                return fmt::format("{} < {}", expression(1), leaf());
            case 2:
                return fmt::format("({} > 0 and {} < 1)", variable(), leaf());
            default:
                return fmt::format("not ({} > 0.5)", leaf());
        }
    }

    std::string block(int depth, const std::string& indent) {
        std::string out;
        const int count = 1 + pick(3);
        for (int i = 0; i < count; ++i) out += statement(depth, indent);
        return out;
    }

    std::string loop(int depth, const std::string& indent) {
        const std::string i = fmt::format("i{}", loops_++);
        const int steps = 1 + pick(4);
        std::string out = fmt::format("{}{} = 0;\n", indent, i);
        if (pick(3) == 0)
            out += fmt::format("{}while {} < {} loop\n", indent, i, steps);
        else
            out += fmt::format("{}while {} < {} and {} loop\n", indent, i, steps, condition());
        return out + block(depth - 1, indent + "  ") +
               fmt::format("{}  {} = {} + 1;\n{}endloop;\n", indent, i, i, indent);
    }

    std::string statement(int depth, const std::string& indent) {
        const int kind = pick(depth > 0 ? 9 : 5);
        switch (kind) {
            case 0:
            case 1:
                return fmt::format("{}{} = {};\n", indent, variable(), expression(2));
            case 2:
                return fmt::format("{}p[{}] = {};\n", indent, index(3), expression(1));
            case 3:
                return fmt::format("{}q[{}] = {};\n", indent, index(4), expression(1));
            case 4:
                return fmt::format("{}t = hfScale3D({}, 2, 0.5, 1);\n", indent, array3());
            case 5:
                return fmt::format("{}if {} then\n{}{}else\n{}{}endif;\n", indent, condition(),
                                   block(depth - 1, indent + "  "), indent, block(depth - 1, indent + "  "),
                                   indent);
            case 6:
                return fmt::format("{}if {} then\n{}{}endif;\n", indent, condition(),
                                   block(depth - 1, indent + "  "), indent);
            default:
                return loop(depth, indent);
        }
    }

    std::uint64_t state_;
    int objects_ = 0;
    int loops_ = 0;
};

}  // namespace frep::test
