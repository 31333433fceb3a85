// What the tests of the pruner share: running a clause tape at a point in binary64, in an emulation of
// binary32, and with derivatives; boxes; and models of set operations in two forms, with R-functions and with
// min and max.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "frep/eval/prune.h"
#include "frep/field/expression.h"
#include "frep/field/meaning.h"
#include "unit/eval/random_graph.h"

namespace frep_test {

/// The values of all rows of a tape at a point, clause by clause.
template <class T, class Run>
std::vector<T> rows_at(const frep::ClauseTape& tape, const std::vector<T>& point, Run run) {
    std::vector<T> rows(tape.rows, T(0.0));
    for (std::size_t i = 0; i < tape.data->constants.size(); ++i) rows[i] = T(tape.data->constants[i]);
    for (std::size_t i = 0; i < point.size(); ++i)
        rows[tape.data->coordinate_row(static_cast<int>(i))] = point[i];
    std::vector<T> arguments;
    for (const frep::Clause& clause : tape.clauses) {
        arguments.clear();
        for (const frep::RowNumber row : tape.operands_of(clause)) arguments.push_back(rows[row]);
        rows[clause.out] = run(clause.op, arguments, tape.block_of(clause));
    }
    return rows;
}

/// F in binary64, or with derivatives.
template <class T>
T value_at(const frep::ClauseTape& tape, const std::vector<T>& point) {
    const auto run = [](frep::Op op, const std::vector<T>& in, std::span<const double> block) {
        return frep::meaning<T>(op, in, block);
    };
    return rows_at<T>(tape, point, run)[tape.root];
}

/// An operation as a binary32 engine of the kind that Pruner promises to enclose may compute it: functions
/// off by an ulp at random, truth by 1e-6 rounded to binary32, R-functions saturated at 1e18.
class FloatEngine {
  public:
    explicit FloatEngine(std::uint64_t seed) : random_(seed) {}

    float operator()(frep::Op op, const std::vector<float>& in, std::span<const double> block) {
        using frep::Op;
        const auto is_true = [](float x) { return std::fabs(x) >= 1e-6f; };
        for (const float x : in)
            if (x != x && frep::info(op).kind == frep::OpKind::plain && op != Op::select) return x;
        switch (op) {
            case Op::truth:
                return is_true(in[0]);
            case Op::logical_not:
                return !is_true(in[0]);
            case Op::logical_and:
                return is_true(in[0]) && is_true(in[1]);
            case Op::logical_or:
                return is_true(in[0]) || is_true(in[1]);
            case Op::equal:
                return std::fabs(in[0] - in[1]) < 1e-6f || in[0] == in[1];
            case Op::select:
                return in[0] != in[0] ? in[0] : is_true(in[0]) ? in[1] : in[2];
            default:
                break;
        }
        const std::vector<double> wide(in.begin(), in.end());
        auto value = static_cast<float>(frep::meaning<double>(op, wide, block));
        if (op == Op::r_and || op == Op::r_or) value = std::clamp(value, -1e18f, 1e18f);
        if (frep::info(op).cost > 2 && value != 0 && std::isnormal(value)) {
            const float end = random_.chance(50) ? INFINITY : -INFINITY;
            if (random_.chance(60) && std::fabs(value) < 1e37f) value = std::nextafter(value, end);
        }
        return value;
    }

  private:
    Random random_;
};

inline float float_value_at(const frep::ClauseTape& tape, const std::vector<double>& point,
                            std::uint64_t seed) {
    const std::vector<float> rounded(point.begin(), point.end());
    return rows_at<float>(tape, rounded, FloatEngine(seed))[tape.root];
}

/// Negative, zero, positive, undefined.
inline int sign_of(double x) { return x != x ? 2 : x < 0 ? -1 : x > 0 ? 1 : 0; }

/// Sixteen boxes or fewer, of all sizes.
inline frep::BoxLanes random_boxes(Random& random, int coordinates) {
    frep::BoxLanes boxes;
    boxes.count = random.chance(70) ? frep::tile_lanes : 1 + static_cast<int>(random.below(16));
    const double size = std::exp2(random.real(-12, 2));
    for (std::size_t k = 0; k < static_cast<std::size_t>(boxes.count); ++k) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(coordinates); ++i) {
            const double low = random.chance(30) ? random.plain(2) : random.real(-2, 2);
            boxes.lo[i][k] = low;
            boxes.hi[i][k] = random.chance(5) ? low : low + size * random.real(0.5, 1);
        }
    }
    return boxes;
}

/// A point of box k, on its boundary now and then.
inline std::vector<double> point_in(Random& random, const frep::BoxLanes& boxes, std::size_t k,
                                    int coordinates) {
    std::vector<double> point;
    for (std::size_t i = 0; i < static_cast<std::size_t>(coordinates); ++i) {
        const double lo = boxes.lo[i][k], hi = boxes.hi[i][k];
        const std::size_t kind = random.below(6);
        point.push_back(kind == 0 ? lo : kind == 1 ? hi : std::min(hi, random.real(lo, hi)));
    }
    return point;
}

/// Box k alone, cut into eight (four, two).
inline frep::BoxLanes halves_of(const frep::BoxLanes& boxes, std::size_t k, int coordinates) {
    frep::BoxLanes parts;
    parts.count = 1 << coordinates;
    for (std::size_t part = 0; part < static_cast<std::size_t>(parts.count); ++part) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(coordinates); ++i) {
            const double lo = boxes.lo[i][k], hi = boxes.hi[i][k], middle = 0.5 * lo + 0.5 * hi;
            parts.lo[i][part] = (part >> i & 1u) ? middle : lo;
            parts.hi[i][part] = (part >> i & 1u) ? hi : middle;
        }
    }
    return parts;
}

/// A model under construction, whose set operations are R-functions or min and max.
class Sketch {
  public:
    using E = frep::Expression;
    explicit Sketch(bool rounded) : rounded_(rounded) {}

    E x(int i) { return {*graph_, graph_->coordinate(i)}; }
    E number(double c) { return {*graph_, graph_->constant(c)}; }
    E both(E a, E b) const { return rounded_ ? r_and(a, b) : min(a, b); }
    E either(E a, E b) const { return rounded_ ? r_or(a, b) : max(a, b); }
    E ball(double a, double b, double c, double r) {
        return r - sqrt(square(x(0) - a) + square(x(1) - b) + square(x(2) - c));
    }
    E box(double a, double b, double c, double s, double t, double u) {
        return both(both(s - abs(x(0) - a), t - abs(x(1) - b)), u - abs(x(2) - c));
    }
    E tree(std::vector<E> parts) const {
        for (std::size_t n = parts.size(); n > 1; n = (n + 1) / 2)
            for (std::size_t i = 0; 2 * i < n; ++i)
                parts[i] = 2 * i + 1 < n ? either(parts[2 * i], parts[2 * i + 1]) : parts[2 * i];
        return parts[0];
    }
    frep::Field field(E root) {
        frep::Field field;
        field.value = root.id();
        field.graph = graph_;
        return field;
    }

  private:
    bool rounded_;
    std::shared_ptr<frep::Graph> graph_ = std::make_shared<frep::Graph>();
};

/// A part with a plate, a boss, a rotated rib, bores and holes.
inline frep::Field machined_part(bool rounded) {
    Sketch s(rounded);
    const auto x = s.x(0), y = s.x(1);
    const auto turned = 0.8660254037844387 * x + 0.5 * y, aside = 0.8660254037844387 * y - 0.5 * x;
    const auto distance = sqrt(square(x) + square(y));
    auto solid = s.either(s.box(0, 0, -0.3, 0.9, 0.6, 0.12), s.both(0.35 - distance, 0.42 - abs(s.x(2))));
    const auto rib = s.both(s.both(0.6 - abs(turned), 0.05 - abs(aside)), 0.25 - abs(s.x(2) + 0.05));
    solid = s.both(s.both(s.either(solid, rib), 1.0 - distance), -(0.2 - distance));
    for (const double a : {-0.75, 0.75})
        for (const double b : {-0.45, 0.45})
            solid = s.both(solid, -(0.06 - sqrt(square(x - a) + square(y - b))));
    solid = s.both(solid, -s.ball(0.9, 0, -0.18, 0.25));
    return s.field(s.both(solid, 0.4 - (0.6 * x + 0.8 * s.x(2))));
}

/// The union of many balls, neighbours near each other in the tree.
inline frep::Field many_balls(bool rounded, int count) {
    Sketch s(rounded);
    Random random(5);
    std::vector<frep::Expression> balls;
    for (int i = 0; i < count; ++i) {
        const double along = -1 + 2.0 * i / count;
        balls.push_back(
            s.ball(along, random.real(-0.8, 0.8), random.real(-0.8, 0.8), random.real(0.05, 0.15)));
    }
    return s.field(s.tree(balls));
}

/// Links joined by bounded blends (and control points), united.
inline frep::Field blended_links(bool rounded, int count) {
    Sketch s(rounded);
    Random random(9);
    std::vector<frep::Expression> parts;
    for (int i = 0; i < count; ++i) {
        const double a = random.real(-0.8, 0.8), b = random.real(-0.8, 0.8), c = random.real(-0.8, 0.8);
        const auto f = s.ball(a, b, c, 0.15), g = s.ball(a + 0.2, b, c, 0.12);
        const auto k = s.number(0.05), one = s.number(1);
        if (i % 3 == 0) {
            parts.push_back(frep::apply(frep::Op::point_uni, {f, g, k, s.number(0.2), s.number(0.15)}));
        } else {
            const auto around = s.ball(a + 0.1, b, c, 0.14);
            parts.push_back(frep::apply(frep::Op::bounded_uni, {f, g, around, k, one, one, one}));
        }
    }
    return s.field(s.both(s.tree(parts), 0.9 - abs(s.x(0))));
}

/// The polynomial smooth maximum (minimum, where `mirrored`) of two fields, in arithmetic.
inline frep::Expression smooth_maximum(frep::Expression a, frep::Expression b, double k, bool mirrored) {
    const auto soft = square(max(k - abs(a - b), 0.0)) / (4 * k);
    return mirrored ? min(a, b) - soft : max(a, b) + soft;
}

/// Balls united by the polynomial smooth maximum; `mirrored`: written with inside negative, then negated.
inline frep::Field smooth_balls(int count, bool mirrored = false) {
    Sketch s(false);
    Random random(6);
    std::vector<frep::Expression> parts;
    for (int i = 0; i < count; ++i) {
        const auto ball = s.ball(-1 + 2.0 * i / count, random.real(-0.8, 0.8), random.real(-0.8, 0.8),
                                 random.real(0.05, 0.15));
        parts.push_back(mirrored ? -ball : ball);
    }
    for (std::size_t n = parts.size(); n > 1; n = (n + 1) / 2)
        for (std::size_t i = 0; 2 * i < n; ++i)
            parts[i] =
                2 * i + 1 < n ? smooth_maximum(parts[2 * i], parts[2 * i + 1], 0.04, mirrored) : parts[2 * i];
    return s.field(mirrored ? -parts[0] : parts[0]);
}

/// The skin of a solid, `thickness` to both sides.
inline frep::Field skin_of(const frep::Field& solid, double thickness) {
    auto graph = std::make_shared<frep::Graph>();
    std::vector<frep::NodeId> renamed(solid.graph->size());
    frep::Field skin = solid;
    *graph = solid.graph->copy_of(std::vector<bool>(solid.graph->size(), true), renamed);
    const auto size = graph->make(frep::Op::abs, {renamed[solid.value]});
    skin.value = graph->make(frep::Op::sub, {graph->constant(thickness), size});
    skin.graph = graph;
    return skin;
}

/// A random solid of set operations of all kinds, with what may stand between them: offsets, factors,
/// negations, sizes, choices, smooth ones, blends; on balls and planes, some of them undefined in places.
class RandomSolid {
  public:
    explicit RandomSolid(std::uint64_t seed) : random_(seed), sketch_(true) {}

    frep::Field make() {
        std::vector<E> pool;
        const std::size_t leaves = 3 + random_.below(12);
        for (std::size_t i = 0; i < leaves; ++i) pool.push_back(leaf());
        while (pool.size() > 1) {
            // operands that are kept may be shared
            const E a = take(pool);
            const E b = random_.chance(85) ? take(pool) : pool[random_.below(pool.size())];
            pool.push_back(between(joined(a, b, pool)));
        }
        return sketch_.field(pool[0]);
    }

  private:
    using E = frep::Expression;

    E number(double c) { return sketch_.number(c); }
    E take(std::vector<E>& pool) {
        const std::size_t i = random_.below(pool.size());
        const E e = pool[i];
        pool.erase(pool.begin() + static_cast<std::ptrdiff_t>(i));
        return e;
    }
    E leaf() {
        const double a = random_.real(-1, 1), b = random_.real(-1, 1), c = random_.real(-1, 1);
        if (random_.chance(20)) return a * sketch_.x(0) + b * sketch_.x(1) + c * sketch_.x(2) + 0.3;
        if (random_.chance(5)) return sqrt(sketch_.x(0) + a) - 0.5;
        if (random_.chance(10)) return square(sketch_.x(0)) + b * sketch_.x(1);
        return sketch_.ball(a, b, c, random_.real(0.1, 0.6));
    }
    E joined(E a, E b, const std::vector<E>& pool) {
        using frep::Op;
        const auto other = [&] { return pool.empty() ? leaf() : pool[random_.below(pool.size())]; };
        const double k = random_.real(0.05, 0.3);
        switch (random_.below(14)) {
            case 0:
            case 1:
                return min(a, b);
            case 2:
            case 3:
                return max(a, b);
            case 4:
                return r_and(a, b);
            case 5:
                return r_or(a, b);
            case 6:
                return min(a, -b);
            case 7:
                return smooth_maximum(a, b, k, random_.chance(50));
            case 8:
                return apply(random_.chance(50) ? Op::bounded_uni : Op::bounded_int,
                             {a, b, leaf(), number(k), number(1), number(1), number(1)});
            case 9:
                return apply(random_.chance(50) ? Op::point_uni : Op::point_int,
                             {a, b, number(k), number(0.3), number(0.3)});
            case 10:
                return select(less(other(), k), a, b);
            case 11: {
                constexpr Op systems[] = {Op::r_alpha_and, Op::r_alpha_or, Op::rp_and,
                                          Op::rp_or,       Op::r0m_and,    Op::r0m_or};
                const auto kind = random_.below(6);
                const double parameter = kind < 2 ? random_.real(-0.9, 1) : random_.real(1.2, 5);
                return apply(systems[kind], {a, b, number(parameter)});
            }
            default:
                return random_.chance(50) ? a * b : a / (1.5 + square(b));
        }
    }
    E between(E e) {
        switch (random_.below(12)) {
            case 0:
                return e + random_.real(-0.1, 0.1);
            case 1:
                return random_.real(0, 0.1) - abs(e);
            case 2:
                return random_.real(-2, 2) * e;
            case 3:
                return e / random_.real(-2, 2);
            case 4:
                return -e;
            case 5:
                return 0.05 - e;
            case 6:
                return e - 0.2 * leaf();
            default:
                return e;
        }
    }

    Random random_;
    Sketch sketch_;
};

}  // namespace frep_test
