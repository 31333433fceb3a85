// Implementation of front_search.h: a stack of bundles, the nearest on top.
#include "frep/trace/front_search.h"

#include <algorithm>

namespace frep::tracing {

namespace {

constexpr std::size_t small_bundle = 64;  ///< rays that are proved one by one
constexpr double short_bundle = 4;        ///< its length, in spacings
constexpr std::size_t small_dear_bundle = 16;
constexpr double short_dear_bundle = 1;
constexpr int parts_along = 16;  ///< of a bundle that is long for its width
constexpr std::size_t parts_across = 4;

Box3 box_between(const Ray& ray, double begin, double end) {
    const Vec3 a = at(ray, begin), b = at(ray, end);
    return {{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
            {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
}

}  // namespace

void FrontSearch::search(std::span<const Ray> rays, std::span<const Reach> reaches, std::span<Hit> hits) {
    rays_ = rays, reaches_ = reaches, hits_ = hits;
    std::fill(hits.begin(), hits.end(), Hit{});
    Bundle all{0, rays.size(), 0, 0, &field_, nullptr, field_.has_dear_ranges()};
    bool is_any = false;
    for (const Reach& reach : reaches) {
        if (!(reach.begin < reach.end)) continue;
        all.begin = is_any ? std::min(all.begin, reach.begin) : reach.begin;
        all.end = is_any ? std::max(all.end, reach.end) : reach.end;
        is_any = true;
    }
    bundles_.clear();
    if (is_any) bundles_.push_back(std::move(all));
    while (!bundles_.empty()) {
        const Bundle bundle = std::move(bundles_.back());
        bundles_.pop_back();
        if (!is_small(bundle))
            divide(bundle);
        else if (bundle.dear)
            take_samples(bundle);
        else
            prove(bundle);
    }
}

bool FrontSearch::is_small(const Bundle& bundle) const {
    const std::size_t count = bundle.dear ? small_dear_bundle : small_bundle;
    const double size = bundle.dear ? short_dear_bundle : short_bundle;
    return bundle.count <= count && bundle.end - bundle.begin <= size * spacing_;
}

/// True for a ray without a hit so far that passes through the bundle's range of distances.
bool FrontSearch::is_open(std::size_t ray, const Bundle& bundle) const {
    const Reach& reach = reaches_[ray];
    return !hits_[ray].is_hit() && reach.begin < bundle.end && bundle.begin < reach.end &&
           reach.begin < reach.end;
}

/// The box around the open rays of a bundle; its min is above its max when there is none.
Box3 FrontSearch::box_of(const Bundle& bundle) const {
    Box3 all{{1, 1, 1}, {0, 0, 0}};
    bool is_any = false;
    for (std::size_t i = bundle.first; i < bundle.first + bundle.count; ++i) {
        if (!is_open(i, bundle)) continue;
        const Box3 box = box_between(rays_[i], std::max(bundle.begin, reaches_[i].begin),
                                     std::min(bundle.end, reaches_[i].end));
        all = is_any ? joined(all, box) : box;
        is_any = true;
    }
    return all;
}

/// From the first ray to the last, at the front.
double FrontSearch::width_of(const Bundle& bundle) const {
    const Ray &a = rays_[bundle.first], &b = rays_[bundle.first + bundle.count - 1];
    return length(at(a, bundle.begin) - at(b, bundle.begin)) + spacing_;
}

/// Puts the parts of a bundle that may hold some of the solid on the stack, the farthest first.
void FrontSearch::divide(const Bundle& bundle) {
    const double size = bundle.end - bundle.begin;
    const std::size_t small = bundle.dear ? small_dear_bundle : small_bundle;
    const bool along_only = bundle.count <= small || size > 4 * width_of(bundle);
    const std::size_t across = along_only ? 1 : parts_across;
    const int along = along_only ? parts_along : parts_along / static_cast<int>(parts_across);
    const std::size_t share = (bundle.count + across - 1) / across;
    parts_.clear(), boxes_.clear();
    for (int k = along; k-- > 0;) {
        for (std::size_t q = 0; q < across && q * share < bundle.count; ++q) {
            Bundle part{bundle.first + q * share,
                        std::min(share, bundle.count - q * share),
                        bundle.begin + size * k / along,
                        k + 1 == along ? bundle.end : bundle.begin + size * (k + 1) / along,
                        bundle.field,
                        bundle.owner,
                        bundle.dear};
            const Box3 box = box_of(part);
            if (box.min.x > box.max.x) continue;
            parts_.push_back(std::move(part));
            boxes_.push_back(box);
        }
    }
    if (parts_.empty()) return;
    ranges_.resize(parts_.size());
    fields_.assign(parts_.size(), nullptr);
    bundle.field->narrow(boxes_, ranges_, fields_);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        if (!ranges_[p].can_be_inside) continue;
        if (fields_[p]) {
            parts_[p].field = fields_[p].get();
            parts_[p].owner = std::move(fields_[p]);
            parts_[p].dear = bundle.dear && parts_[p].field->has_dear_ranges();
        }
        bundles_.push_back(std::move(parts_[p]));
    }
}

/// The first hits within a small bundle.
void FrontSearch::prove(const Bundle& bundle) {
    brackets_.clear(), found_.clear();
    start_walkers(bundle);
    while (!walking_.empty()) {
        take_stretches(*bundle.field);
        halve_stretches(*bundle.field);
    }
    finish(*bundle.field);
}

/// The first changes of sign between samples within a small bundle, on the rays that are not proved empty.
void FrontSearch::take_samples(const Bundle& bundle) {
    brackets_.clear(), found_.clear(), runs_.clear(), boxes_.clear();
    for (std::size_t i = bundle.first; i < bundle.first + bundle.count; ++i) {
        if (!is_open(i, bundle)) continue;
        const double begin = std::max(bundle.begin, reaches_[i].begin);
        const double end = std::min(bundle.end, reaches_[i].end);
        runs_.push_back({i, begin, end, samples_within(begin, end, resolution_)});
        boxes_.push_back(box_between(rays_[i], begin, end));
    }
    ranges_.resize(boxes_.size());
    bundle.field->ranges(boxes_, ranges_);
    std::size_t next = 0;
    std::erase_if(runs_, [&](const SampledRun&) { return !ranges_[next++].can_be_inside; });
    if (runs_.empty()) return;
    find_crossings(rays_, *bundle.field, runs_, columns_, [&](const SampledRun& run, const Bracket& found) {
        if (found.in > run.begin) {
            brackets_.push_back(found);
            return;
        }
        // the solid begins at the clip box, or the root lies a rounding error before this run
        const Reach& reach = reaches_[run.ray];
        hits_[run.ray].t = run.begin;
        hits_[run.ray].cut_by = run.begin <= reach.begin ? reach.side : std::uint8_t{0};
        found_.push_back(run.ray);
    });
    finish(*bundle.field);
}

/// Walkers at the front of the bundle, their first stretch ending at its back.
void FrontSearch::start_walkers(const Bundle& bundle) {
    walking_.clear(), columns_.clear();
    std::size_t count = 0;
    for (std::size_t i = bundle.first; i < bundle.first + bundle.count; ++i) {
        if (!is_open(i, bundle)) continue;
        if (walkers_.size() <= count) walkers_.emplace_back();
        Walker& w = walkers_[count];
        w.ray = i;
        w.at = std::max(bundle.begin, reaches_[i].begin);
        w.ends.assign(1, {std::min(bundle.end, reaches_[i].end), 0.0});
        walking_.push_back(count++);
        columns_.add(at(rays_[i], w.at));
        columns_.add(at(rays_[i], w.ends.back().first));
    }
    const std::span<const double> f = columns_.values(*bundle.field);
    std::erase_if(walking_, [&](std::size_t n) {
        Walker& w = walkers_[n];
        w.ends.back().second = f[2 * n + 1];
        const bool is_entry = w.at == reaches_[w.ray].begin;
        if (!is_entry || !(f[2 * n] >= 0)) return false;
        hits_[w.ray].t = w.at;
        hits_[w.ray].cut_by = reaches_[w.ray].side;
        found_.push_back(w.ray);
        return true;
    });
}

/// Judges the front stretch of every walker: empty and passed, short with a change of sign and found, short
/// and passed, or to be halved.
void FrontSearch::take_stretches(SampledField& field) {
    boxes_.clear(), halved_.clear();
    for (const std::size_t n : walking_) {
        const Walker& w = walkers_[n];
        boxes_.push_back(box_between(rays_[w.ray], w.at, w.ends.back().first));
    }
    ranges_.resize(boxes_.size());
    field.ranges(boxes_, ranges_);
    std::size_t next = 0;
    std::erase_if(walking_, [&](std::size_t n) {
        Walker& w = walkers_[n];
        const auto [end, f_end] = w.ends.back();
        const bool is_empty = !ranges_[next++].can_be_inside && !(f_end >= 0);
        const double middle = 0.5 * (w.at + end);
        if (!is_empty && end - w.at > resolution_ && w.at < middle && middle < end) {
            halved_.push_back(n);
            return false;
        }
        if (!is_empty && f_end >= 0) {
            brackets_.push_back({w.ray, w.at, end, -Hit::never, f_end, 0});
            return true;
        }
        w.at = end;
        w.ends.pop_back();
        return w.ends.empty();
    });
}

void FrontSearch::halve_stretches(SampledField& field) {
    if (halved_.empty()) return;
    columns_.clear();
    for (const std::size_t n : halved_) {
        const Walker& w = walkers_[n];
        columns_.add(at(rays_[w.ray], 0.5 * (w.at + w.ends.back().first)));
    }
    const std::span<const double> f = columns_.values(field);
    for (std::size_t h = 0; h < halved_.size(); ++h) {
        Walker& w = walkers_[halved_[h]];
        const double middle = 0.5 * (w.at + w.ends.back().first);
        if (f[h] >= 0) w.ends.clear();  // what lies behind does not count
        w.ends.push_back({middle, f[h]});
    }
}

/// Roots of the brackets, and gradients of all that was found.
void FrontSearch::finish(SampledField& field) {
    find_roots(rays_, field, brackets_, columns_);
    for (const Bracket& b : brackets_) {
        hits_[b.ray].t = b.in;
        found_.push_back(b.ray);
    }
    columns_.clear();
    for (const std::size_t ray : found_) columns_.add(at(rays_[ray], hits_[ray].t));
    columns_.gradients(field);
    for (std::size_t n = 0; n < found_.size(); ++n) hits_[found_[n]].gradient = columns_.gradient(n);
}

}  // namespace frep::tracing
