// Implementation of clip.h.
#include "frep/measure/clip.h"

#include <algorithm>
#include <cstddef>

#include "frep/measure/pairs.h"

namespace frep::measuring {

namespace {

using Point = std::array<double, 3>;

/// A simplex of the cut: corners, and the function there.
template <int D>
struct Simplex {
    std::array<Point, D + 1> at;
    std::array<double, D + 1> value;
};

/// Adds up moments of simplices, or their sizes alone; coordinates in -1..1.
template <int D>
class Sum {
  public:
    explicit Sum(bool sizes_alone) : sizes_alone_(sizes_alone) {}

    /// `weight` times the integrals over the simplex, whose share of the cube is `share`.
    void add(const std::array<Point, D + 1>& at, double share, double weight) {
        const double w = weight * share;
        moments_.share += w;
        if (sizes_alone_) return;
        Point total{};
        for (const Point& p : at)
            for (std::size_t i = 0; i < D; ++i) total[i] += p[i];
        for (std::size_t i = 0; i < D; ++i) moments_.first[i] += w * total[i] / (D + 1);
        for (std::size_t k = 0; k < 6; ++k) {
            const auto [i, j] = pairs[k];
            if (i >= D || j >= D) continue;
            double products = total[i] * total[j];
            for (const Point& p : at) products += p[i] * p[j];
            moments_.second[k] += w * products / ((D + 1) * (D + 2));
        }
    }
    const PartMoments& moments() const { return moments_; }

  private:
    bool sizes_alone_;
    PartMoments moments_;
};

/// The share of the edge from a corner with value a > 0 to one with b <= 0 where the function is positive.
double positive_share(double a, double b) { return a / (a - b); }

template <int D>
Point along(const Point& a, const Point& b, double t) {
    Point out{};
    for (std::size_t i = 0; i < D; ++i) out[i] = a[i] + t * (b[i] - a[i]);
    return out;
}

/// Adds the corner at vertex 0, whose sign differs from that of all others.
template <int D>
void add_corner(const Simplex<D>& s, double whole, double weight, Sum<D>& sum) {
    std::array<Point, D + 1> at{};
    at[0] = s.at[0];
    double share = whole;
    for (std::size_t k = 1; k <= D; ++k) {
        const double t = s.value[0] > 0 ? positive_share(s.value[0], s.value[k])
                                        : positive_share(-s.value[0], -s.value[k]);
        at[k] = along<D>(s.at[0], s.at[k], t);
        share *= t;
    }
    sum.add(at, share, weight);
}

/// Adds the wedge at the edge from vertex 0 to vertex 1, which are positive; 2 and 3 are not.
void add_wedge(const Simplex<3>& s, double whole, Sum<3>& sum) {
    const double ac = positive_share(s.value[0], s.value[2]), ad = positive_share(s.value[0], s.value[3]);
    const double bc = positive_share(s.value[1], s.value[2]), bd = positive_share(s.value[1], s.value[3]);
    const Point& a = s.at[0];
    const Point& b = s.at[1];
    const Point pac = along<3>(a, s.at[2], ac), pad = along<3>(a, s.at[3], ad);
    const Point pbc = along<3>(b, s.at[2], bc), pbd = along<3>(b, s.at[3], bd);
    sum.add({a, pac, pad, pbd}, whole * ac * ad * (1 - bd), 1);
    sum.add({a, pac, pbc, pbd}, whole * ac * bd * (1 - bc), 1);
    sum.add({a, b, pbc, pbd}, whole * bc * bd, 1);
}

template <int D>
void add_positive(Simplex<D> s, Sum<D>& sum) {
    constexpr double whole = D == 2 ? 1.0 / 2 : 1.0 / 6;
    // the positive corners first
    std::size_t positive = 0;
    for (std::size_t k = 0; k <= D; ++k) {
        if (!(s.value[k] > 0)) continue;
        std::swap(s.value[positive], s.value[k]);
        std::swap(s.at[positive], s.at[k]);
        ++positive;
    }
    if (positive == 0) return;
    if (positive == 1) return add_corner(s, whole, 1, sum);
    if constexpr (D == 3) {
        if (positive == 2) return add_wedge(s, whole, sum);
    }
    sum.add(s.at, whole, 1);
    if (positive == D + 1) return;
    std::swap(s.value[0], s.value[D]);
    std::swap(s.at[0], s.at[D]);
    if (s.value[0] < 0) add_corner(s, whole, -1, sum);
}

template <int D>
PartMoments positive_part_of(std::span<const double> corners, bool sizes_alone) {
    Sum<D> sum(sizes_alone);
    std::array<std::size_t, D> order{};
    for (std::size_t i = 0; i < D; ++i) order[i] = i;
    do {
        Simplex<D> s;
        std::size_t corner = 0;
        Point at{-1, -1, -1};
        for (std::size_t k = 0;; ++k) {
            s.at[k] = at;
            s.value[k] = corners[corner];
            if (k == D) break;
            corner |= std::size_t{1} << order[k];
            at[order[k]] = 1;
        }
        add_positive<D>(s, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    return sum.moments();
}

PartMoments part_of(int dimension, std::span<const double> corners, bool sizes_alone) {
    return dimension == 2 ? positive_part_of<2>(corners, sizes_alone)
                          : positive_part_of<3>(corners, sizes_alone);
}

PartMoments lattice_part(int dimension, std::span<const double> points, bool sizes_alone) {
    const auto d = static_cast<std::size_t>(dimension);
    const std::size_t parts = std::size_t{1} << d;
    const double weight = 1 / static_cast<double>(parts);
    PartMoments out, whole;
    whole.share = 1;
    for (std::size_t k = 0; k < d; ++k) whole.second[k] = 1.0 / 3;
    std::array<double, 8> corners{};
    for (std::size_t part = 0; part < parts; ++part) {
        bool any = false, all = true;
        for (std::size_t corner = 0; corner < parts; ++corner) {
            std::size_t point = 0, step = 1;
            for (std::size_t k = 0; k < d; ++k, step *= 3)
                point += ((part >> k & 1u) + (corner >> k & 1u)) * step;
            corners[corner] = points[point];
            any = any || corners[corner] > 0;
            all = all && corners[corner] > 0;
        }
        if (!any) continue;
        const PartMoments m = all ? whole : part_of(dimension, {corners.data(), parts}, sizes_alone);
        // u = (side + v)/2, with v the coordinates of the part
        const auto side = [&](std::size_t k) { return part >> k & 1u ? 1.0 : -1.0; };
        out.share += weight * m.share;
        if (sizes_alone) continue;
        for (std::size_t k = 0; k < d; ++k) out.first[k] += weight * 0.5 * (side(k) * m.share + m.first[k]);
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            const auto [i, j] = pairs[p];
            if (i >= d || j >= d) continue;
            out.second[p] +=
                weight * 0.25 *
                (side(i) * side(j) * m.share + side(i) * m.first[j] + side(j) * m.first[i] + m.second[p]);
        }
    }
    return out;
}

}  // namespace

PartMoments positive_part(int dimension, std::span<const double> corners) {
    return part_of(dimension, corners, false);
}

PartMoments positive_part_of_lattice(int dimension, std::span<const double> points) {
    return lattice_part(dimension, points, false);
}

double positive_share_of_lattice(int dimension, std::span<const double> points) {
    return lattice_part(dimension, points, true).share;
}

}  // namespace frep::measuring
