// Implementation of radial.h.
#include "frep/shapes/radial.h"

#include <algorithm>

#include <fmt/format.h>

#include "frep/math/number.h"
#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

/// Points nearer than this share of their extent count as one.
constexpr double same_place = 1e-7;
/// Holds slopes that the points do not determine at 0; the values are met all the same.
constexpr double slope_damping = 1e-10;

/// A square matrix with right sides, row by row.
class LinearSystem {
  public:
    LinearSystem(std::size_t n, std::size_t sides)
        : n_(n), width_(n + sides), rows_(n * width_, 0.0), row_(n) {
        for (std::size_t i = 0; i < n; ++i) row_[i] = rows_.data() + i * width_;
    }
    double& at(std::size_t i, std::size_t j) { return row_[i][j]; }
    double& side(std::size_t i, std::size_t k) { return row_[i][n_ + k]; }

    /// Gaussian elimination with partial pivoting (Golub and Van Loan 2013, 3.4), in panels of columns whose
    /// rows stay in the cache; each element is changed in the order of the columns whatever their width. The
    /// right sides become the solutions. False for a singular matrix.
    bool solve() {
        constexpr std::size_t panel = 32;
        for (std::size_t begin = 0; begin < n_; begin += panel) {
            const std::size_t end = std::min(begin + panel, n_);
            for (std::size_t k = begin; k < end; ++k) {
                if (!bring_pivot(k)) return false;
                for (std::size_t i = k + 1; i < n_; ++i) {
                    row_[i][k] /= row_[k][k];
                    subtract(i, k, k + 1, end);
                }
            }
            for (std::size_t i = begin + 1; i < n_; ++i)
                for (std::size_t k = begin; k < std::min(i, end); ++k) subtract(i, k, end, width_);
        }
        for (std::size_t i = n_; i-- > 0;)
            for (std::size_t column = n_; column < width_; ++column) {
                double sum = row_[i][column];
                for (std::size_t j = i + 1; j < n_; ++j) sum -= row_[i][j] * row_[j][column];
                row_[i][column] = sum / row_[i][i];
            }
        return true;
    }

  private:
    bool bring_pivot(std::size_t k) {
        std::size_t best = k;
        for (std::size_t i = k + 1; i < n_; ++i)
            if (math::abs(row_[i][k]) > math::abs(row_[best][k])) best = i;
        std::swap(row_[k], row_[best]);
        return math::abs(row_[k][k]) > 0.0;
    }
    /// Row i less its multiplier times row k, in the columns from `first` to before `last`.
    void subtract(std::size_t i, std::size_t k, std::size_t first, std::size_t last) {
        double* to = row_[i];
        const double *from = row_[k], factor = to[k];
        for (std::size_t j = first; j < last; ++j) to[j] -= factor * from[j];
    }

    std::size_t n_, width_;
    std::vector<double> rows_;
    std::vector<double*> row_;
};

double distance(const RadialPoint& a, const RadialPoint& b) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return math::sqrt(sum);
}

/// The points moved and scaled into a cube of edge 1 about the origin.
struct Normalised {
    RadialPoint middle{};
    double extent = 0;
    std::vector<RadialPoint> points;
    std::vector<std::size_t> kept;  ///< their numbers in the problem

    explicit Normalised(const RadialProblem& problem) {
        RadialPoint low = problem.points.front(), high = low;
        for (const RadialPoint& p : problem.points)
            for (std::size_t k = 0; k < 4; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        for (std::size_t k = 0; k < 4; ++k) {
            middle[k] = 0.5 * low[k] + 0.5 * high[k];
            extent = std::max(extent, high[k] - low[k]);
        }
        if (!(extent > 0)) extent = 1;  // one point
        for (std::size_t i = 0; i < problem.points.size(); ++i) {
            RadialPoint p;
            for (std::size_t k = 0; k < 4; ++k) p[k] = (problem.points[i][k] - middle[k]) / extent;
            const bool is_new = std::none_of(points.begin(), points.end(), [&](const RadialPoint& other) {
                return distance(p, other) < same_place;
            });
            if (!is_new) continue;
            points.push_back(p);
            kept.push_back(i);
        }
    }
};

std::string problem_of(const RadialProblem& problem) {
    if (problem.points.empty()) return "there are no points to interpolate";
    if (problem.points.size() > most_radial_points)
        return fmt::format("more than {} points to interpolate", most_radial_points);
    const auto finite = [](double v) { return v - v == 0; };
    for (const RadialPoint& p : problem.points)
        if (!std::all_of(p.begin(), p.end(), finite)) return "a point to interpolate is not finite";
    for (const auto& column : problem.values) {
        FREP_CHECK(column.size() == problem.points.size());
        if (!std::all_of(column.begin(), column.end(), finite)) return "a value to interpolate is not finite";
    }
    return {};
}

}  // namespace

RadialFit fit_radial(const RadialProblem& problem) {
    RadialFit fit;
    fit.problem = problem_of(problem);
    if (!fit.problem.empty()) return fit;
    const Normalised scaled(problem);
    std::vector<std::size_t> slopes;
    for (std::size_t k = 0; k < 4; ++k)
        if (problem.used[k]) slopes.push_back(k);
    const std::size_t count = scaled.points.size(), terms = slopes.size() + 1, n = count + terms;
    LinearSystem system(n, problem.values.size());
    for (std::size_t i = 0; i < count; ++i) {
        const RadialPoint& p = scaled.points[i];
        for (std::size_t j = 0; j < count; ++j) {
            const double r = distance(p, scaled.points[j]);
            system.at(i, j) = r * r * r;
        }
        for (std::size_t s = 0; s < terms; ++s)
            system.at(i, count + s) = system.at(count + s, i) = s == 0 ? 1.0 : p[slopes[s - 1]];
        for (std::size_t column = 0; column < problem.values.size(); ++column)
            system.side(i, column) = problem.values[column][scaled.kept[i]];
    }
    for (std::size_t s = 1; s < terms; ++s) system.at(count + s, count + s) = -slope_damping;
    if (!system.solve()) {
        fit.problem = "the points to interpolate give a singular system";
        return fit;
    }
    const double cube = scaled.extent * scaled.extent * scaled.extent;
    for (std::size_t column = 0; column < problem.values.size(); ++column) {
        std::vector<double> sum(5, 0.0);
        sum[4] = system.side(count, column);
        for (std::size_t s = 0; s < slopes.size(); ++s) {
            const std::size_t k = slopes[s];
            sum[k] = system.side(count + 1 + s, column) / scaled.extent;
            sum[4] -= sum[k] * scaled.middle[k];
        }
        for (std::size_t i = 0; i < count; ++i) {
            const RadialPoint& p = problem.points[scaled.kept[i]];
            sum.insert(sum.end(), p.begin(), p.end());
            sum.push_back(system.side(i, column) / cube);
        }
        fit.sums.push_back(std::move(sum));
    }
    return fit;
}

Expression radial_sum(Build& build, const std::array<Expression, 4>& place, const std::vector<double>& sum) {
    std::vector<Expression> data;
    data.reserve(sum.size());
    for (const double item : sum) data.push_back(build.constant(item));
    return block(build, Op::radial_cubic, {place[0], place[1], place[2], place[3]}, data);
}

}  // namespace frep::shapes
