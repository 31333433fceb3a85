// Implementation of predicates.h. The error bounds are those of Shewchuk (1997), figures 21 and 22 (stage A),
// with 2^-53 for the unit roundoff.
#include "frep/geom/predicates.h"

#include <array>
#include <cstddef>

namespace frep {

namespace {

constexpr double roundoff = 0x1p-53;
constexpr double orient2d_bound = (3 + 16 * roundoff) * roundoff;
constexpr double orient3d_bound = (7 + 56 * roundoff) * roundoff;

constexpr double size(double x) { return x < 0 ? -x : x; }
constexpr int sign(double x) { return (x > 0) - (x < 0); }

/// A sum of doubles: `high` rounded, `low` the exact rest.
struct Split {
    double high, low;
};

Split two_sum(double a, double b) {
    const double s = a + b, t = s - a;
    return {s, (a - (s - t)) + (b - t)};
}

/// For |a| >= |b| or a = 0.
Split fast_two_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
}

/// Veltkamp's split into 26 bits each.
Split halves(double a) {
    const double c = 134217729.0 * a;  // 2^27 + 1
    const double high = c - (c - a);
    return {high, a - high};
}

/// Dekker's product.
Split two_product(double a, double b) {
    const double p = a * b;
    const Split x = halves(a), y = halves(b);
    return {p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

/// A sum of up to N doubles that do not overlap, by rising size, without zeros (the number 0 has no terms).
template <std::size_t N>
class Expansion {
  public:
    std::size_t count() const { return count_; }
    double operator[](std::size_t i) const { return terms_[i]; }
    void append(double term) {
        if (term != 0) terms_[count_++] = term;
    }
    int sign_of_sum() const { return count_ == 0 ? 0 : sign(terms_[count_ - 1]); }

  private:
    std::array<double, N> terms_;
    std::size_t count_ = 0;
};

Expansion<2> difference(double a, double b) {
    const Split d = two_sum(a, -b);
    Expansion<2> e;
    e.append(d.low);
    e.append(d.high);
    return e;
}

/// Fast-Expansion-Sum: the terms of both, merged by size, run through a chain of two_sum.
template <std::size_t M, std::size_t N>
Expansion<M + N> operator+(const Expansion<M>& e, const Expansion<N>& f) {
    Expansion<M + N> sum;
    double carried = 0;
    std::size_t i = 0, j = 0;
    while (i < e.count() || j < f.count()) {
        const bool from_e = j == f.count() || (i < e.count() && size(e[i]) < size(f[j]));
        const Split s = two_sum(carried, from_e ? e[i++] : f[j++]);
        sum.append(s.low);
        carried = s.high;
    }
    sum.append(carried);
    return sum;
}

/// Scale-Expansion.
template <std::size_t N>
Expansion<2 * N> operator*(const Expansion<N>& e, double factor) {
    Expansion<2 * N> product;
    if (e.count() == 0 || factor == 0) return product;
    const Split first = two_product(e[0], factor);
    product.append(first.low);
    double carried = first.high;
    for (std::size_t i = 1; i < e.count(); ++i) {
        const Split p = two_product(e[i], factor);
        const Split s = two_sum(carried, p.low);
        product.append(s.low);
        const Split t = fast_two_sum(p.high, s.high);
        product.append(t.low);
        carried = t.high;
    }
    product.append(carried);
    return product;
}

template <std::size_t N>
Expansion<4 * N> operator*(const Expansion<N>& e, const Expansion<2>& f) {
    const Expansion<2 * N> low = e * (f.count() > 0 ? f[0] : 0);
    return low + e * (f.count() > 1 ? f[1] : 0);
}

template <std::size_t N>
Expansion<N> negated(const Expansion<N>& e) {
    Expansion<N> result;
    for (std::size_t i = 0; i < e.count(); ++i) result.append(-e[i]);
    return result;
}

/// a d - b c.
Expansion<16> minor(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c,
                    const Expansion<2>& d) {
    return a * d + negated(b * c);
}

int exact_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Expansion<2> ax = difference(a.x, d.x), ay = difference(a.y, d.y), az = difference(a.z, d.z);
    const Expansion<2> bx = difference(b.x, d.x), by = difference(b.y, d.y), bz = difference(b.z, d.z);
    const Expansion<2> cx = difference(c.x, d.x), cy = difference(c.y, d.y), cz = difference(c.z, d.z);
    return (minor(bx, by, cx, cy) * az + minor(cx, cy, ax, ay) * bz + minor(ax, ay, bx, by) * cz)
        .sign_of_sum();
}

int exact_orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
    return minor(difference(a.x, c.x), difference(a.y, c.y), difference(b.x, c.x), difference(b.y, c.y))
        .sign_of_sum();
}

}  // namespace

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 p = a - d, q = b - d, r = c - d;
    const double qxry = q.x * r.y, rxqy = r.x * q.y;
    const double rxpy = r.x * p.y, pxry = p.x * r.y;
    const double pxqy = p.x * q.y, qxpy = q.x * p.y;
    const double det = p.z * (qxry - rxqy) + q.z * (rxpy - pxry) + r.z * (pxqy - qxpy);
    const double permanent = (size(qxry) + size(rxqy)) * size(p.z) + (size(rxpy) + size(pxry)) * size(q.z) +
                             (size(pxqy) + size(qxpy)) * size(r.z);
    const double bound = orient3d_bound * permanent;
    if (det > bound || -det > bound || permanent == 0) return sign(det);
    return exact_orient3d(a, b, c, d);
}

int orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
    const double det = left - right;
    const double bound = orient2d_bound * (size(left) + size(right));
    if (det > bound || -det > bound || (left == 0 && right == 0)) return sign(det);
    return exact_orient2d(a, b, c);
}

}  // namespace frep
