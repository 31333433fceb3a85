// The loops of march_kernels.h; included by one file for each instruction set. No function of std is called
// here, and all that stands in no template over a lane type has internal linkage (tools/check_isa). Tested by
// tests/unit/trace/tile_depth_test.cpp.
#pragma once

#include "frep/math/lanes.h"
#include "frep/trace/march_kernels.h"

namespace frep::march {
namespace {

using math::LanesOf;

/// One bit a lane of a mask, lane 0 lowest.
template <class E, int N>
unsigned bits_of(math::LaneMaskOf<E, N> mask) {
    const auto v = mask.items.v;
#if defined(__AVX512F__)
    if constexpr (sizeof(v) == 64) {
        if constexpr (N == 16) return _mm512_movepi32_mask(reinterpret_cast<__m512i>(v));
        if constexpr (N == 8) return _mm512_movepi64_mask(reinterpret_cast<__m512i>(v));
    }
#elif defined(__AVX2__)
    if constexpr (N == 8) return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(v)));
    if constexpr (N == 4) return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(v)));
#elif defined(__SSE2__)
    if constexpr (N == 4) return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(v)));
    if constexpr (N == 2) return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(v)));
#else
    unsigned bits = 0;
    for (int i = 0; i < N; ++i) bits |= (v[i] != 0 ? 1u : 0u) << i;
    return bits;
#endif
}

#if defined(__AVX2__) && !defined(__AVX512F__)
/// For eight lanes of 32 bits and each choice of them: where they come from when the chosen ones move down.
struct MoveTable {
    alignas(32) unsigned char from[256][8];
};
constexpr MoveTable make_moves() {
    MoveTable table{};
    for (int bits = 0; bits < 256; ++bits) {
        int to = 0;
        for (int i = 0; i < 8; ++i)
            if ((bits >> i & 1) != 0) table.from[bits][to++] = static_cast<unsigned char>(i);
    }
    return table;
}
constexpr MoveTable moves = make_moves();
/// The same choice of four lanes of 64 bits, as one of eight.
constexpr unsigned char doubled[16] = {0x00, 0x03, 0x0c, 0x0f, 0x30, 0x33, 0x3c, 0x3f,
                                       0xc0, 0xc3, 0xcc, 0xcf, 0xf0, 0xf3, 0xfc, 0xff};
#endif

/// Writes the chosen lanes (not all, not none) to `to` one after another; what comes after them up to a
/// register is overwritten.
template <class E, int N>
void store_chosen(LanesOf<E, N> value, unsigned bits, E* to) {
#if defined(__AVX512F__)
    const auto v = value.items.v;
    if constexpr (sizeof(v) == 64 && sizeof(E) == 4) {
        const auto packed =
            _mm512_maskz_compress_ps(static_cast<__mmask16>(bits), reinterpret_cast<__m512>(v));
        __builtin_memcpy(to, &packed, sizeof(packed));
    } else if constexpr (sizeof(v) == 64) {
        const auto packed =
            _mm512_maskz_compress_pd(static_cast<__mmask8>(bits), reinterpret_cast<__m512d>(v));
        __builtin_memcpy(to, &packed, sizeof(packed));
    } else {
        static_assert(sizeof(v) == 32 && sizeof(E) == 4);
        const auto packed =
            _mm256_maskz_compress_ps(static_cast<__mmask8>(bits), reinterpret_cast<__m256>(v));
        __builtin_memcpy(to, &packed, sizeof(packed));
    }
#elif defined(__AVX2__)
    const unsigned choice = sizeof(E) == 4 ? bits : doubled[bits];
    const auto v = value.items.v;
    const __m256i from =
        _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(&moves.from[choice][0])));
    const auto packed = _mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(v), from);
    __builtin_memcpy(to, &packed, sizeof(packed));
#else
    E lanes[N];
    value.store(lanes);
    for (int i = 0; i < N; ++i) {
        __builtin_memcpy(to, &lanes[i], sizeof(E));
        to += bits >> i & 1u;
    }
#endif
}

/// The loops for N lanes.
template <class Real, int N>
struct Loops {
    using L = LanesOf<Real, N>;
    using I = Index<Real>;
    static constexpr unsigned every = (1u << N) - 1;

    static L load(const Real* from) { return L::load(from); }
    /// Integers as the lanes of their bits.
    static L load(const I* from) {
        L value;
        __builtin_memcpy(&value, from, sizeof(value));
        return value;
    }
    static void keep(L value, unsigned bits, Real* to) {
        if (bits == every) return value.store(to);
        store_chosen(value, bits, to);
    }
    static void keep(L value, unsigned bits, I* to) {
        keep(value, bits, reinterpret_cast<Real*>(to));  // written as bytes
    }
    static L absolute(L a) { return L(a.bits() & math::Format<Real>::magnitude); }
    static L larger(L a, L b) { return select(less(a, b), b, a); }
    static L square_root(L a) {
        return L(math::each<typename L::Items>([](auto v) { return math::square_roots(v); }, a.items));
    }

    /// Bit i: pixel i of a row of a block has met nothing yet.
    static unsigned open_pixels(const std::uint16_t* layers, int width) {
#if defined(__SSE2__)
        if (width == 8) {
            __m128i row;
            __builtin_memcpy(&row, layers, sizeof(row));
            const __m128i open = _mm_cmpeq_epi16(row, _mm_setzero_si128());
            return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(open, _mm_setzero_si128())));
        }
#endif
        unsigned bits = 0;
        for (int i = 0; i < width; ++i) bits |= (layers[i] == 0 ? 1u : 0u) << i;
        return bits;
    }

    static int count_open(const PixelBlock<Real>& block) {
        int count = 0;
        for (int j = 0; j < block.height; ++j)
            count += __builtin_popcount(
                open_pixels(block.layers + static_cast<std::size_t>(j) * block.row_stride, block.width));
        return count;
    }

    static void add(const PixelBlock<Real>& given, Rays<Real>& result) {
        const PixelBlock<Real> block =
            given;  // copies stay in registers: stores of lanes could change others
        Rays<Real> rays = result;
        for (int j = 0; j < block.height; ++j) {
            const std::size_t row = static_cast<std::size_t>(j) * block.row_stride;
            const unsigned open = open_pixels(block.layers + row, block.width);
            if (block.width == 8) {
                Loops<Real, (N < 8 ? N : 8)>::add_eight(block, j, open, rays);
                continue;
            }
            for (int i = 0; i < block.width; ++i) {
                if ((open >> i & 1u) == 0) continue;
                rays.x[rays.count] = block.x[i];
                rays.y[rays.count] = block.y[j];
                rays.pixel[rays.count++] = static_cast<I>(block.first + row + static_cast<std::size_t>(i));
            }
        }
        result.count = rays.count;
    }
    /// The rays of row j, where the block has eight pixels in a row and N is at most eight.
    static inline __attribute__((always_inline)) void add_eight(const PixelBlock<Real>& block, int j,
                                                                unsigned open, Rays<Real>& rays) {
        static constexpr I steps[8] = {0, 1, 2, 3, 4, 5, 6, 7};
        using Integers = math::Pack<I, N>;
        const I first = static_cast<I>(block.first + static_cast<std::size_t>(j) * block.row_stride);
        const L y(block.y[j]);
        for (int i = 0; i < 8; i += N) {
            const unsigned bits = open >> i & every;
            if (bits == 0) continue;
            I pixel[N];
            Integers{Integers::load(steps + i).v + first}.store(pixel);
            keep(load(block.x + i), bits, rays.x + rays.count);
            keep(load(pixel), bits, rays.pixel + rays.count);
            y.store(rays.y + rays.count);
            rays.count += static_cast<std::size_t>(__builtin_popcount(bits));
        }
    }

    static void points(const Rays<Real>& given, const Real* middles, int front, int layers, Real* x, Real* y,
                       Real* z) {
        const Rays<Real> rays = given;
        for (int i = 0; i < layers; ++i) {
            const L at(middles[front - i]);
            // what a layer writes beyond its end the next one overwrites
            for (std::size_t c = 0; c < rays.count; c += N) {
                load(rays.x + c).store(x + c);
                load(rays.y + c).store(y + c);
                at.store(z + c);
            }
            x += rays.count;
            y += rays.count;
            z += rays.count;
        }
    }

    static void advance(const Slab<Real>& given, Rays<Real>& all_rays, Hits<Real>& all_hits) {
        const Slab<Real> slab = given;
        const Rays<Real> rays = all_rays;
        const Hits<Real> hits = all_hits;
        const std::size_t count = rays.count;
        const L nothing(__builtin_nan(""));
        const L zero(0.0), one(1.0);
        std::size_t left = 0, found = hits.count;
        for (std::size_t c = 0; c < count; c += N) {
            const unsigned valid = count - c >= N ? every : (1u << (count - c)) - 1;
            const Real* const values = slab.values + c;
            const L last = load(values + static_cast<std::size_t>(slab.count - 1) * count);
            L f = last, inside = zero, outside = zero, inner = zero, outer = zero, layer = zero;
            auto hit = less(one, zero);
            for (int i = slab.count; i-- > slab.skipped;) {
                const L in_front = i > 0           ? load(values + static_cast<std::size_t>(i - 1) * count)
                                   : slab.is_first ? nothing
                                                   : load(rays.before + c);
                const auto here = less_equal(zero, f);
                const int number = slab.front - i;
                hit = hit | here;
                inside = select(here, f, inside);
                outside = select(here, in_front, outside);
                inner = select(here, L(slab.middles[number]), inner);
                outer = select(here, L(slab.middles[number < slab.last ? number + 1 : number]), outer);
                layer = select(here, L(static_cast<Real>(number)), layer);
                f = in_front;
            }
            const L x = load(rays.x + c), y = load(rays.y + c), pixel = load(rays.pixel + c);
            const unsigned done = bits_of(hit) & valid, open = valid & ~done;
            if (done != 0) {
                const L share = inside / (inside - outside);
                const auto chord = less_equal(zero, share) & less_equal(share, one);
                keep(x, done, hits.x + found);
                keep(y, done, hits.y + found);
                keep(select(chord, inner + share * (outer - inner), inner), done, hits.z + found);
                keep(inner, done, hits.inner + found);
                keep(outer, done, hits.outer + found);
                keep(layer, done, hits.layer + found);
                keep(pixel, done, hits.pixel + found);
                found += static_cast<std::size_t>(__builtin_popcount(done));
            }
            if (open != 0) {
                keep(x, open, rays.x + left);
                keep(y, open, rays.y + left);
                keep(last, open, rays.before + left);
                keep(pixel, open, rays.pixel + left);
                left += static_cast<std::size_t>(__builtin_popcount(open));
            }
        }
        all_rays.count = left;
        all_hits.count = found;
    }

    static void paint(const Hits<Real>& all_hits, const Gradients<Real>& gradients, int last,
                      const Canvas& picture) {
        const Hits<Real> hits = all_hits;
        const Gradients<Real> at = gradients;
        const Canvas canvas = picture;
        const L zero(0.0), one(1.0), front(static_cast<Real>(last));
        const L most(static_cast<Real>(math::Format<Real>::max_finite));
        for (std::size_t c = 0; c < hits.count; c += N) {
            const L x = load(at.x + c), y = load(at.y + c), z = load(at.z + c);
            const L start = load(hits.z + c), layer = load(hits.layer + c);
            const L better = start - load(at.value + c) / z;
            const auto between =
                less_equal(load(hits.inner + c), better) & less_equal(better, load(hits.outer + c));
            const L size = larger(larger(absolute(x), absolute(y)), absolute(z));
            const L a = x / size, b = y / size, d = z / size;
            const L length = -square_root(a * a + b * b + d * d);
            const auto good = less(zero, size) & less_equal(size, most) & less(layer, front);
            Real height[N], nx[N], ny[N], nz[N];
            select(between, better, start).store(height);
            select(good, a / length, zero).store(nx);
            select(good, b / length, zero).store(ny);
            select(good, d / length, one).store(nz);
            const std::size_t some = hits.count - c < N ? hits.count - c : N;
            for (std::size_t k = 0; k < some; ++k) {
                const auto pixel = static_cast<std::size_t>(hits.pixel[c + k]);
                canvas.layers[pixel] = static_cast<std::uint16_t>(static_cast<int>(hits.layer[c + k]) + 1);
                canvas.z[pixel] = static_cast<float>(height[k]);
                float* const normal = canvas.normals + 3 * pixel;
                normal[0] = static_cast<float>(nx[k]);
                normal[1] = static_cast<float>(ny[k]);
                normal[2] = static_cast<float>(nz[k]);
            }
        }
    }
};

/// The loops for registers of this instruction set.
template <class Real>
constexpr Kernels<Real> table() {
    using Here = Loops<Real, math::register_bytes / static_cast<int>(sizeof(Real))>;
    return {Here::add, Here::count_open, Here::points, Here::advance, Here::paint};
}
constexpr Kernels<float> float_table = table<float>();
constexpr Kernels<double> double_table = table<double>();

}  // namespace
}  // namespace frep::march
