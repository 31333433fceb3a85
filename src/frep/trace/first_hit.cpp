// Implementation of first_hit.h.
#include "frep/trace/first_hit.h"

#include <algorithm>

#include "frep/trace/cell_walk.h"

namespace frep::tracing {

namespace {

constexpr int cells_a_chunk = 4;
constexpr int profile_samples = 5;   ///< in front of a root
constexpr double profile_gap = 0.3;  ///< between them, in cells
constexpr int most_proofs = 32;      ///< interval evaluations for one chunk of a ray
constexpr int most_steps = 60;       ///< of the search for one root

Vec3 at(const Ray& ray, double t) { return ray.origin + ray.direction * t; }

Box3 box_of(const Ray& ray, double begin, double end) {
    const Vec3 a = at(ray, begin), b = at(ray, end);
    return {{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
            {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
}

Box3 joined(const Box3& a, const Box3& b) {
    return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y), std::min(a.min.z, b.min.z)},
            {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y), std::max(a.max.z, b.max.z)}};
}

}  // namespace

struct FirstHit::Segment {
    double begin, end;
};

/// Rays with numbers of one group of `span`: active_[first ...], and a share of each one's stretch.
struct FirstHit::Packet {
    std::size_t first, count, span;
    double longest;  ///< of the stretches
    double begin, end;
};

struct FirstHit::State {
    CellWalk walk;
    Stretch chunk;
    double entry = 0;           ///< where the ray enters the clip box
    int side = -1;              ///< by which side
    bool entry_unknown = true;  ///< whether the solid reaches that point is not known
    std::size_t first_sample = 0, samples = 0;
    bool has_root = false;
    double out = 0, in = 0;      ///< bracket of the root
    double f_out = 0, f_in = 0;  ///< F at its ends
    int stalled = 0;
    int proofs = 0;
    bool is_plain = false;      ///< F rises evenly up to the root
    double proved = 0;          ///< nothing lies in front of this
    bool goes_on = false;       ///< the next chunk begins where this one ends
    std::vector<Segment> open;  ///< to be proved empty, the front one last
};

FirstHit::FirstHit(const DistanceGrid& grid, SampledField& field, double leaf, std::size_t group,
                   double finest)
    : grid_(grid), field_(field), leaf_(leaf), group_(group), finest_(finest * grid.step()) {}
FirstHit::~FirstHit() = default;

void FirstHit::evaluate() {
    f_.resize(x_.size());
    if (!x_.empty()) field_.values({x_, y_, z_}, f_);
}

void FirstHit::begin(std::span<const Ray> rays) {
    rays_ = rays;
    if (states_.size() < rays.size()) states_.resize(rays.size());
    active_.clear();
    const std::array<int, 3>& n = grid_.cells();
    const Vec3 far_corner = grid_.origin() + Vec3{n[0] * 1.0, n[1] * 1.0, n[2] * 1.0} * grid_.step();
    const Box3 lattice{grid_.origin(), far_corner};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Stretch within, in_lattice;
        int side = -1, unused = -1;
        if (!clip_to_box(rays[i], grid_.clip(), within, side)) continue;
        if (!clip_to_box(rays[i], lattice, in_lattice, unused)) continue;
        State& s = states_[i];
        s.entry = within.begin;
        s.side = side;
        s.goes_on = false;
        s.entry_unknown = side >= 0 && within.begin >= in_lattice.begin;
        s.walk = CellWalk(grid_, rays[i],
                          {std::max(within.begin, in_lattice.begin), std::min(within.end, in_lattice.end)});
        active_.push_back(i);
    }
}

void FirstHit::trace(std::span<const Ray> rays, std::span<Hit> hits) {
    std::fill(hits.begin(), hits.end(), Hit{});
    if (!grid_.has_solid()) return;
    begin(rays);
    while (!active_.empty()) {
        next_chunks(hits);
        sample_chunks(hits);
        rooted_.clear();
        for (const std::size_t i : active_)
            if (states_[i].has_root) rooted_.push_back(i);
        find_roots(rooted_);
        if (finest_ > 0 && !grid_.sampled()) {
            take_profiles();
            prove_packets();
            verify();
        }
        std::erase_if(active_, [&](std::size_t i) {
            if (!states_[i].has_root) return false;
            hits[i].t = states_[i].in;
            return true;
        });
    }
}

/// The next chunk of every active ray; rays without one are done.
void FirstHit::next_chunks(std::span<Hit>) {
    std::erase_if(active_, [&](std::size_t i) {
        State& s = states_[i];
        const bool went_on = s.goes_on;
        if (!s.walk.next(grid_, cells_a_chunk, s.chunk)) return true;
        if (!went_on) s.proved = s.chunk.begin;
        s.goes_on = s.walk.goes_on(grid_);
        return false;
    });
}

/// Samples about a cell apart; finds the first change of sign, and solids that begin at the clip box.
void FirstHit::sample_chunks(std::span<Hit> hits) {
    x_.clear(), y_.clear(), z_.clear();
    const double spacing = grid_.step() * (finest_ > 0 && !grid_.sampled() ? 1.0 : 0.5);
    for (const std::size_t i : active_) {
        State& s = states_[i];
        s.first_sample = x_.size();
        const double size = s.chunk.end - s.chunk.begin;
        s.samples = static_cast<std::size_t>(std::max(1.0, __builtin_ceil(size / spacing)));
        for (std::size_t n = 0; n <= s.samples; ++n) {
            const double share = static_cast<double>(n) / static_cast<double>(s.samples);
            const Vec3 p = at(rays_[i], s.chunk.begin + size * share);
            x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
        }
    }
    evaluate();
    std::erase_if(active_, [&](std::size_t i) {
        State& s = states_[i];
        const double* f = f_.data() + s.first_sample;
        s.has_root = false;
        if (f[0] >= 0) {
            // The solid begins at the clip box, or the root lies a rounding error before this chunk.
            hits[i].t = s.chunk.begin;
            if (s.entry_unknown && s.chunk.begin <= s.entry)
                hits[i].cut_by = static_cast<std::uint8_t>(1 + s.side);
            return true;
        }
        s.entry_unknown = false;
        const double size = s.chunk.end - s.chunk.begin;
        for (std::size_t n = 1; n <= s.samples && !s.has_root; ++n) {
            if (!(f[n] >= 0)) continue;
            const auto place = [&](std::size_t k) {
                return s.chunk.begin + size * (static_cast<double>(k) / static_cast<double>(s.samples));
            };
            s.has_root = true;
            s.out = place(n - 1), s.f_out = f[n - 1];
            s.in = place(n), s.f_in = f[n];
        }
        return false;
    });
}

/// Narrows the brackets of some rays to 1e-9 of their distance: false position, the weight of an end that
/// stays halved (Dowell and Jarratt 1971, "Illinois"), halving where that does not gain or F is no number.
void FirstHit::find_roots(const std::vector<std::size_t>& which) {
    std::vector<std::size_t> open = which;
    std::vector<double> places;
    for (const std::size_t i : open) states_[i].stalled = 0;
    for (int step = 0; step < most_steps && !open.empty(); ++step) {
        x_.clear(), y_.clear(), z_.clear(), places.clear();
        std::erase_if(open, [&](std::size_t i) {
            const State& s = states_[i];
            return s.in - s.out <= 1e-9 * __builtin_fabs(s.in) || s.f_in == 0;
        });
        for (const std::size_t i : open) {
            const State& s = states_[i];
            double t = s.out + (s.in - s.out) * (s.f_out / (s.f_out - s.f_in));
            const bool halve = step % 4 == 3 && step > 8;
            if (halve || !(t > s.out && t < s.in)) t = s.out + 0.5 * (s.in - s.out);
            places.push_back(t);
            const Vec3 p = at(rays_[i], t);
            x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
        }
        evaluate();
        for (std::size_t n = 0; n < open.size(); ++n) {
            State& s = states_[open[n]];
            if (f_[n] >= 0) {
                if (s.stalled > 0) s.f_out *= 0.5;
                s.in = places[n], s.f_in = f_[n];
                s.stalled = 1;
            } else {
                if (s.stalled < 0) s.f_in *= 0.5;
                s.out = places[n], s.f_out = f_[n];
                s.stalled = -1;
            }
        }
    }
}

/// Looks whether F rises evenly, from sample to sample, just in front of the roots found.
void FirstHit::take_profiles() {
    x_.clear(), y_.clear(), z_.clear();
    const double gap = profile_gap * grid_.step();
    for (const std::size_t i : rooted_)
        for (int n = profile_samples; n >= 1; --n) {
            const Vec3 p = at(rays_[i], states_[i].out - n * gap);
            x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
        }
    evaluate();
    const double* f = f_.data();
    for (const std::size_t i : rooted_) {
        double least = 1e300, greatest = 0;
        for (int n = 0; n < profile_samples; ++n) {
            const double rise = (n + 1 < profile_samples ? f[n + 1] : 0.0) - f[n];
            least = rise < least ? rise : least;
            greatest = rise > greatest ? rise : greatest;
        }
        bool is_defined = true;
        for (int n = 0; n < profile_samples; ++n) is_defined = is_defined && f[n] < 0;
        states_[i].is_plain = is_defined && least > 0.3 * greatest;
        f += profile_samples;
    }
}

/// How far the proofs of a ray go at present. Just in front of a root evenly rising samples stand for them;
/// just in front of what is still to come they wait for the next chunk, which may show a root.
double FirstHit::proof_end(const State& s) const {
    const double profile = profile_samples * profile_gap * grid_.step();
    if (s.has_root) return s.out - (s.is_plain ? profile : leaf_);
    return s.goes_on ? s.chunk.end - profile : s.chunk.end;
}

/// Proves neighbours together: packets of rays, and the same share of each one's stretch. What cannot be
/// proved is divided across or along, whichever way it is longer; what is left stays open for single rays.
void FirstHit::prove_packets() {
    std::vector<Packet> packets = first_packets(), divided;
    while (!packets.empty()) {
        boxes_.clear();
        for (const Packet& packet : packets) boxes_.push_back(box_of_packet(packet));
        ranges_.resize(boxes_.size());
        field_.ranges(boxes_, ranges_);
        divided.clear();
        for (std::size_t p = 0; p < packets.size(); ++p)
            if (ranges_[p].can_be_inside) divide(packets[p], divided);
        packets.swap(divided);
    }
    for (const std::size_t i : active_) {
        State& s = states_[i];
        s.proved = std::max(s.proved, proof_end(s));
        std::sort(s.open.begin(), s.open.end(),
                  [](const Segment& a, const Segment& b) { return a.begin > b.begin; });
    }
}

std::vector<FirstHit::Packet> FirstHit::first_packets() {
    std::vector<Packet> packets;
    for (std::size_t first = 0, last = 0; first < active_.size(); first = last) {
        Packet packet{first, 0, group_, 0, 0, 1};
        for (last = first; last < active_.size() && active_[last] / group_ == active_[first] / group_;
             ++last) {
            State& s = states_[active_[last]];
            s.open.clear();
            s.proofs = 0;
            packet.longest = std::max(packet.longest, proof_end(s) - s.proved);
        }
        packet.count = last - first;
        if (packet.longest > 0) packets.push_back(packet);
    }
    return packets;
}

Box3 FirstHit::box_of_packet(const Packet& packet) const {
    Box3 all{{1, 1, 1}, {0, 0, 0}};
    for (std::size_t n = packet.first; n < packet.first + packet.count; ++n) {
        const State& s = states_[active_[n]];
        const double size = proof_end(s) - s.proved;
        if (!(size > 0)) continue;
        const Box3 box =
            box_of(rays_[active_[n]], s.proved + size * packet.begin, s.proved + size * packet.end);
        all = all.min.x > all.max.x ? box : joined(all, box);
    }
    return all;
}

void FirstHit::divide(const Packet& packet, std::vector<Packet>& out) {
    const double along = packet.longest * (packet.end - packet.begin);
    const double across = packet.span > 1 ? 2 * leaf_ * __builtin_sqrt(static_cast<double>(packet.span)) : 0;
    if (across >= along && packet.span > 1 && across > 0.3 * grid_.step()) {
        const std::size_t span = packet.span >= 4 ? packet.span / 4 : 1;
        const std::size_t stop = packet.first + packet.count;
        for (std::size_t first = packet.first, last = first; first < stop; first = last) {
            Packet part{first, 0, span, 0, packet.begin, packet.end};
            for (last = first; last < stop && active_[last] / span == active_[first] / span; ++last) {
                const State& s = states_[active_[last]];
                part.longest = std::max(part.longest, proof_end(s) - s.proved);
            }
            part.count = last - first;
            if (part.longest > 0) out.push_back(part);
        }
        return;
    }
    if (along > 0.4 * grid_.step()) {
        const double middle = 0.5 * (packet.begin + packet.end);
        Packet half = packet;
        half.end = middle;
        out.push_back(half);
        half = packet;
        half.begin = middle;
        out.push_back(half);
        return;
    }
    for (std::size_t n = packet.first; n < packet.first + packet.count; ++n) {
        State& s = states_[active_[n]];
        const double size = proof_end(s) - s.proved;
        if (size > 0) s.open.push_back({s.proved + size * packet.begin, s.proved + size * packet.end});
    }
}

/// Proves that nothing lies between the beginning of each chunk and its root, or finds what does.
void FirstHit::verify() {
    std::vector<std::size_t> open;
    std::vector<Segment> segments;
    for (const std::size_t i : active_)
        if (!states_[i].open.empty()) open.push_back(i);
    while (!open.empty()) {
        boxes_.clear(), segments.clear();
        for (const std::size_t i : open) {
            const Segment segment = states_[i].open.back();
            states_[i].open.pop_back();
            ++states_[i].proofs;
            segments.push_back(segment);
            boxes_.push_back(box_of(rays_[i], segment.begin, segment.end));
        }
        ranges_.resize(boxes_.size());
        field_.ranges(boxes_, ranges_);
        // Halve what is not proved.
        x_.clear(), y_.clear(), z_.clear();
        std::vector<std::size_t> halved;
        for (std::size_t n = 0; n < open.size(); ++n) {
            const Segment& segment = segments[n];
            const bool goes_on = ranges_[n].can_be_inside && segment.end - segment.begin > finest_ &&
                                 states_[open[n]].proofs < most_proofs;
            if (!goes_on) continue;
            halved.push_back(n);
            const Vec3 p = at(rays_[open[n]], 0.5 * (segment.begin + segment.end));
            x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
        }
        evaluate();
        rooted_.clear();
        std::vector<double> middles = f_;
        for (std::size_t h = 0; h < halved.size(); ++h) {
            const std::size_t n = halved[h];
            State& s = states_[open[n]];
            const double middle = 0.5 * (segments[n].begin + segments[n].end);
            if (middles[h] >= 0) {
                s.open.clear();
                s.has_root = true;
                s.out = segments[n].begin, s.f_out = -__builtin_inf();
                s.in = middle, s.f_in = middles[h];
                rooted_.push_back(open[n]);
            } else {
                s.open.push_back({middle, segments[n].end});
                s.open.push_back({segments[n].begin, middle});
            }
        }
        find_roots(rooted_);
        for (std::size_t h = 0; h < halved.size(); ++h) {
            const std::size_t n = halved[h];
            State& s = states_[open[n]];
            if (middles[h] >= 0 && s.out - leaf_ > segments[n].begin)
                s.open.push_back({segments[n].begin, s.out - leaf_});
        }
        std::erase_if(open, [&](std::size_t i) { return states_[i].open.empty(); });
    }
}

}  // namespace frep::tracing
