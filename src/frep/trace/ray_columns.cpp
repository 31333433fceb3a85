// Implementation of ray_columns.h.
#include "frep/trace/ray_columns.h"

namespace frep::tracing {

namespace {

constexpr int most_steps = 60;  ///< of the search for one root

bool is_narrow(const Bracket& b) { return b.in - b.out <= 1e-9 * __builtin_fabs(b.in) || b.f_in == 0; }

double next_place(const Bracket& b, int step) {
    const double t = b.out + (b.in - b.out) * (b.f_out / (b.f_out - b.f_in));
    const bool halve = step % 4 == 3 && step > 8;
    return halve || !(t > b.out && t < b.in) ? b.out + 0.5 * (b.in - b.out) : t;
}

void move_end(Bracket& b, double place, double f) {
    if (f >= 0) {
        if (b.stalled > 0) b.f_out *= 0.5;
        b.in = place, b.f_in = f;
        b.stalled = 1;
    } else {
        if (b.stalled < 0) b.f_in *= 0.5;
        b.out = place, b.f_out = f;
        b.stalled = -1;
    }
}

}  // namespace

std::span<const double> RayColumns::values(SampledField& field) {
    f_.resize(x_.size());
    if (!x_.empty()) field.values(points(), f_);
    return f_;
}

void RayColumns::gradients(SampledField& field) {
    for (auto* column : {&f_, &gx_, &gy_, &gz_}) column->resize(x_.size());
    if (!x_.empty()) field.gradients(points(), f_, {gx_, gy_, gz_});
}

void find_roots(std::span<const Ray> rays, SampledField& field, std::span<Bracket> brackets,
                RayColumns& columns) {
    std::vector<std::size_t> open;
    std::vector<double> places;
    for (std::size_t n = 0; n < brackets.size(); ++n) {
        brackets[n].stalled = 0;
        open.push_back(n);
    }
    for (int step = 0; step < most_steps; ++step) {
        std::erase_if(open, [&](std::size_t n) { return is_narrow(brackets[n]); });
        if (open.empty()) return;
        columns.clear(), places.clear();
        for (const std::size_t n : open) {
            places.push_back(next_place(brackets[n], step));
            columns.add(at(rays[brackets[n].ray], places.back()));
        }
        const std::span<const double> f = columns.values(field);
        for (std::size_t k = 0; k < open.size(); ++k) move_end(brackets[open[k]], places[k], f[k]);
    }
}

}  // namespace frep::tracing
