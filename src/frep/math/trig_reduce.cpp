// Payne-Hanek reduction in integer arithmetic: x * 2/pi modulo 4 with 190 binary places. See trig_reduce.h.
// Checked by tests/unit/math/kernels_test.cpp.
#include "frep/math/trig_reduce.h"

#include "frep/math/coefficients.h"

FREP_MATH_OPEN
namespace {

__extension__ typedef unsigned __int128 Wide;

/// The 64 binary digits of 2/pi that start `first` places after the point (negative: zeros).
std::uint64_t digits_from(int first) {
    const auto& words = coefficients::two_over_pi_digits;
    const auto word = [&](int i) { return i < 0 ? std::uint64_t{0} : words[i]; };
    const int index = first >= 0 ? first / 64 : -((63 - first) / 64);
    const int shift = first - 64 * index;
    return shift == 0 ? word(index) : (word(index) << shift) | (word(index + 1) >> (64 - shift));
}

/// The number (top, mid, low) / 2^192 as a pair of doubles; top's sign bit is clear.
Pair<double> fraction_to_pair(std::uint64_t top, std::uint64_t mid, std::uint64_t low) {
    double unit = 0x1p-64;
    while (top == 0 && unit > 0x1p-150) {
        top = mid;
        mid = low;
        low = 0;
        unit *= 0x1p-64;
    }
    if (top == 0) return {0.0, 0.0};
    const int shift = __builtin_clzll(top);
    if (shift > 0) {
        top = (top << shift) | (mid >> (64 - shift));
        mid = (mid << shift) | (low >> (64 - shift));
    }
    const double scale = unit / static_cast<double>(std::uint64_t{1} << shift);
    const std::uint64_t upper = top & ~std::uint64_t{0x7ff};
    const double rest = static_cast<double>(top & 0x7ff) + static_cast<double>(mid >> 11) * 0x1p-53;
    return fast_sum(static_cast<double>(upper) * scale, rest * scale);
}

}  // namespace

ReducedAngle reduce_huge_angle(double x) {
    const std::uint64_t bits = to_bits(x);
    const int exponent = static_cast<int>((bits >> 52) & 0x7ff) - 1075;  // |x| = m * 2^exponent
    const std::uint64_t m = (bits & 0xfffffffffffffu) | 0x10000000000000u;
    // Digits of 2/pi whose products with m matter modulo 4: from place exponent - 2 on (bit of weight 2^2
    // cut).
    std::uint64_t product[4];
    Wide carry = 0;
    for (int i = 3; i >= 0; --i) {
        carry += static_cast<Wide>(m) * digits_from(exponent - 2 + 64 * i);
        product[i] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
    }
    // product / 2^254 modulo 4: two integer bits, then 254 places of which the last 53 are uncertain.
    int quadrant = static_cast<int>(product[0] >> 62);
    std::uint64_t top = (product[0] << 2) | (product[1] >> 62);
    std::uint64_t mid = (product[1] << 2) | (product[2] >> 62);
    std::uint64_t low = (product[2] << 2) | (product[3] >> 62);
    const bool negative = (top >> 63) != 0;
    if (negative) {
        quadrant = (quadrant + 1) & 3;
        low = ~low + 1;
        mid = ~mid + (low == 0 ? 1 : 0);
        top = ~top + (low == 0 && mid == 0 ? 1 : 0);
    }
    namespace c = coefficients;
    const Pair<double> f = fraction_to_pair(top, mid, low);
    const Pair<double> p = exact_product(f.hi, c::half_pi_hi);
    Pair<double> rest = fast_sum(p.hi, p.lo + (f.hi * c::half_pi_lo + f.lo * c::half_pi_hi));
    if (negative) rest = {-rest.hi, -rest.lo};
    if ((bits >> 63) != 0) {
        rest = {-rest.hi, -rest.lo};
        quadrant = (4 - quadrant) & 3;
    }
    return {rest, quadrant};
}

FREP_MATH_CLOSE
