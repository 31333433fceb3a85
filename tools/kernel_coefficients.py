#!/usr/bin/env python3
"""Writes src/frep/math/coefficients.h: the constants of the math kernels, from nothing but integers.

Every polynomial is the interpolant of a power series at Chebyshev nodes, computed with 70 digits, its
degree the least one whose error on the interval stays under the bound given; the coefficients are then
rounded to binary64. Long constants (pi/2, ln 2, 2/pi) come from series in exact integer arithmetic, cut into
parts with trailing zeros. Checked by tests/unit/math/kernels_test.cpp. Use, then clang-format:

    tools/kernel_coefficients.py > src/frep/math/coefficients.h
    tools/kernel_coefficients.py single > src/frep/math/single/coefficients.h

The second is for binary32: the same with larger bounds, rounded to that format.
"""
import struct
import sys
from decimal import Decimal, getcontext
from fractions import Fraction

getcontext().prec = 70
BITS = 1400


def inverse_arctan(n, sign):
    """arctan(1/n) for sign -1, artanh(1/n) for sign +1, times 2^(BITS+64)."""
    total, power, k = 0, (1 << (BITS + 64)) // n, 0
    while power:
        term = power // (2 * k + 1)
        total += term if sign > 0 or k % 2 == 0 else -term
        power //= n * n
        k += 1
    return total


ONE = 1 << (BITS + 64)
PI = Fraction(4 * (4 * inverse_arctan(5, -1) - inverse_arctan(239, -1)), ONE)
LN2 = Fraction(2 * inverse_arctan(3, 1), ONE)
LN10 = Fraction(3 * LN2 + Fraction(2 * inverse_arctan(9, 1), ONE))  # 10 = 8 * 5/4 and 5/4 = (9+1)/(9-1)


def decimal(x):
    return Decimal(x.numerator) / Decimal(x.denominator)


def cosine(x):
    total, term, k = Decimal(0), Decimal(1), 0
    while abs(term) > Decimal(10) ** -68:
        total += term
        k += 2
        term = -term * x * x / (k * (k - 1))
    return total


def interpolate(f, low, high, degree):
    """Monomial coefficients (Decimals) of the polynomial through f at the Chebyshev nodes of [low, high]."""
    n = degree + 1
    pi = decimal(PI)
    nodes = [(low + high) / 2 + (high - low) / 2 * cosine(pi * (2 * i + 1) / (2 * n)) for i in range(n)]
    table = [f(x) for x in nodes]
    for level in range(1, n):  # Newton's divided differences
        for i in range(n - 1, level - 1, -1):
            table[i] = (table[i] - table[i - 1]) / (nodes[i] - nodes[i - level])
    poly = [table[n - 1]]
    for i in range(n - 2, -1, -1):  # multiply by (x - node), add the next difference
        shifted = [Decimal(0)] + poly
        poly = [s - nodes[i] * p for s, p in zip(shifted, poly + [Decimal(0)])]
        poly[0] += table[i]
    return poly


def series(coefficient, terms):
    values = [decimal(coefficient(k)) for k in range(terms)]

    def f(x):
        total = Decimal(0)
        for c in reversed(values):
            total = total * x + c
        return total

    return f


def factorial(n):
    return 1 if n < 2 else n * factorial(n - 1)


def single(x):
    """x rounded to binary32."""
    return struct.unpack("f", struct.pack("f", float(x)))[0]


def polynomial(name, meaning, f, low, high, bound, rounded=float):
    low, high = Decimal(low), Decimal(high)
    for degree in range(2, 24):
        poly = interpolate(f, low, high, degree)
        worst = Decimal(0)
        for i in range(201):
            x = low + (high - low) * i / 200
            value = Decimal(0)
            for c in reversed(poly):
                value = value * x + c
            worst = max(worst, abs(value - f(x)))
        if worst < Decimal(bound):
            break
    print(f"/// {meaning}, for z in [{low}, {high}]; error {worst:.1e}.")
    body = ", ".join(rounded(c).hex() for c in poly)
    print(f"inline constexpr double {name}[] = {{{body}}};\n")


def part(x, bits):
    """The leading `bits` bits of the Fraction x, cut."""
    exponent = 0
    while x * Fraction(2) ** exponent < 2 ** (bits - 1):
        exponent += 1
    while x * Fraction(2) ** exponent >= 2**bits:
        exponent -= 1
    return Fraction(int(x * Fraction(2) ** exponent)) / Fraction(2) ** exponent


def parts(names, meaning, x, sizes, rounded=float):
    print(f"/// {meaning}")
    for name, bits in zip(names, sizes):
        p = part(x, bits) if bits not in (24, 53) else Fraction(rounded(x))
        print(f"inline constexpr double {name} = {float(p).hex()};")
        x -= p
    print()


def main_single():
    print("// The constants of the kernels of binary32, all of them floats. Written by")
    print("// tools/kernel_coefficients.py (method there). Do not edit. Checked by")
    print("// tests/unit/math/single_functions_test.cpp.\n#pragma once\n")
    print('#include "frep/math/isa.h"\n\nFREP_MATH_OPEN\nnamespace single::coefficients {\n')
    polynomial("exp_tail", "(e^z - 1 - z)/z^2", series(lambda k: Fraction(1, factorial(k + 2)), 40),
               "-0.3470", "0.3470", "1e-7", single)
    polynomial("artanh_tail", "2 (artanh(s)/s - 1)/z with z = s^2",
               series(lambda k: Fraction(2, 2 * k + 3), 60), "0", "0.0295", "4e-7", single)
    polynomial("sin_tail", "(sin(x) - x)/x^3 with z = x^2",
               series(lambda k: Fraction((-1) ** (k + 1), factorial(2 * k + 3)), 30), "0", "0.6175", "1e-9", single)
    polynomial("cos_tail", "(cos(x) - 1)/z with z = x^2",
               series(lambda k: Fraction((-1) ** (k + 1), factorial(2 * k + 2)), 30), "0", "0.6175", "2e-9", single)
    polynomial("atan_tail", "(atan(x) - x)/x^3 with z = x^2",
               series(lambda k: Fraction((-1) ** (k + 1), 2 * k + 3), 110), "0", "0.1717", "4e-8", single)
    parts(["half_pi_1", "half_pi_2", "half_pi_3", "half_pi_4"], "pi/2 in parts of 12, 12, 12 and 24 bits.",
          PI / 2, [12, 12, 12, 24], single)
    parts(["ln2_1", "ln2_2"], "ln 2 in parts of 15 and 24 bits.", LN2, [15, 24], single)
    parts(["half_pi_hi", "half_pi_lo"], "pi/2 in two floats.", PI / 2, [24, 24], single)
    parts(["quarter_pi_hi", "quarter_pi_lo"], "pi/4 in two floats.", PI / 4, [24, 24], single)
    parts(["pi_hi", "pi_lo"], "pi in two floats.", PI, [24, 24], single)
    parts(["three_quarter_pi_hi", "three_quarter_pi_lo"], "3 pi/4 in two floats.", PI * 3 / 4, [24, 24], single)
    parts(["log2_e"], "1/ln 2.", 1 / LN2, [24], single)
    parts(["two_over_pi"], "2/pi.", 2 / PI, [24], single)
    parts(["tan_eighth_pi"], "tan(pi/8) = sqrt(2) - 1.", Fraction(Decimal(2).sqrt() - 1), [24], single)
    print("}  // namespace single::coefficients\nFREP_MATH_CLOSE")


def main():
    print("// The constants of the math kernels. Written by tools/kernel_coefficients.py (method there).")
    print("// Do not edit. Checked by tests/unit/math/kernels_test.cpp against MPFR.\n#pragma once\n")
    print("#include <cstdint>\n")
    print('#include "frep/math/isa.h"\n\nFREP_MATH_OPEN\nnamespace coefficients {\n')
    polynomial("exp_tail", "(e^z - 1 - z)/z^2", series(lambda k: Fraction(1, factorial(k + 2)), 40),
               "-0.3467", "0.3467", "2e-18")
    polynomial("artanh_tail", "(artanh(s)/s - 1 - z/3)/z^2 with z = s^2",
               series(lambda k: Fraction(1, 2 * k + 5), 60), "0", "0.0295", "1e-17")
    polynomial("sin_tail", "(sin(x) - x)/x^3 with z = x^2",
               series(lambda k: Fraction((-1) ** (k + 1), factorial(2 * k + 3)), 30), "0", "0.6170", "1e-18")
    polynomial("cos_tail", "(cos(x) - 1 + z/2)/z^2 with z = x^2",
               series(lambda k: Fraction((-1) ** k, factorial(2 * k + 4)), 30), "0", "0.6170", "1e-18")
    polynomial("atan_tail", "(atan(x) - x)/x^3 with z = x^2",
               series(lambda k: Fraction((-1) ** (k + 1), 2 * k + 3), 110), "0", "0.1717", "4e-18")
    parts(["half_pi_1", "half_pi_2", "half_pi_3", "half_pi_4"], "pi/2 in parts of 33, 33, 33 and 53 bits.",
          PI / 2, [33, 33, 33, 53])
    parts(["half_pi_hi", "half_pi_lo", "half_pi_end"], "pi/2 in three doubles.", PI / 2, [53, 53, 53])
    parts(["quarter_pi_hi", "quarter_pi_lo"], "pi/4 in two doubles.", PI / 4, [53, 53])
    parts(["three_quarter_pi_hi", "three_quarter_pi_lo"], "3 pi/4 in two doubles.", PI * 3 / 4, [53, 53])
    parts(["pi_hi", "pi_lo"], "pi in two doubles.", PI, [53, 53])
    parts(["ln2_1", "ln2_2"], "ln 2 in parts of 42 and 53 bits.", LN2, [42, 53])
    parts(["log10_e_hi", "log10_e_lo"], "1/ln 10 in two doubles.", 1 / LN10, [53, 53])
    parts(["third_hi", "third_lo"], "1/3 in two doubles.", Fraction(1, 3), [53, 53])
    parts(["log2_e"], "1/ln 2.", 1 / LN2, [53])
    parts(["two_over_pi"], "2/pi.", 2 / PI, [53])
    parts(["tan_eighth_pi"], "tan(pi/8) = sqrt(2) - 1, where atan changes its reduction.",
          Fraction(Decimal(2).sqrt() - 1), [53])
    digits = int(2 / PI * Fraction(2) ** 1280)
    words = ", ".join(f"0x{(digits >> (1280 - 64 * (i + 1))) & (2**64 - 1):016x}" for i in range(20))
    print("/// The first 1280 binary digits of 2/pi, the most significant word first.")
    print(f"inline constexpr std::uint64_t two_over_pi_digits[] = {{{words}}};\n")
    print("}  // namespace coefficients\nFREP_MATH_CLOSE")


if sys.argv[1:] == ["single"]:
    main_single()
else:
    main()
