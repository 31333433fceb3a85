// Implementation of plane_levels.h. Powers of ten are read from text, so that every number is the double
// nearest to its decimal.
#include "frep/trace/plane_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace frep::drawing {

namespace {

bool is_finite(double v) { return v - v == 0; }

double decimal(std::int64_t digits, int exponent) {
    const std::string text = fmt::format("{}e{}", digits, exponent);
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// The exponent of the decimal form d.ddd * 10^e of a finite value other than 0.
int decimal_exponent(double value) {
    const std::string text = fmt::format("{:.17e}", value);
    return std::atoi(text.c_str() + text.find('e') + 1);
}

/// Signs of typography: a true minus.
std::string typeset(const std::string& text) {
    if (!text.starts_with('-')) return text;
    std::string out = "\xe2\x88\x92";
    out.append(text, 1);
    return out;
}

/// " (x10^e)" with superscript digits.
std::string factor_text(int exponent) {
    static constexpr const char* superscripts[] = {
        "\xe2\x81\xb0", "\xc2\xb9",     "\xc2\xb2",     "\xc2\xb3",     "\xe2\x81\xb4",
        "\xe2\x81\xb5", "\xe2\x81\xb6", "\xe2\x81\xb7", "\xe2\x81\xb8", "\xe2\x81\xb9"};
    std::string out =
        " (\xc3\x97"
        "10";
    for (const char c : std::to_string(exponent)) out += c == '-' ? "\xe2\x81\xbb" : superscripts[c - '0'];
    return out + ")";
}

/// The samples that decide about levels: defined and finite, thinned to about 2^18, ascending.
std::vector<double> typical_samples(std::span<const double> samples) {
    const std::size_t stride = samples.size() / (std::size_t{1} << 18) | 1;  // odd: no fixed columns
    std::vector<double> out;
    for (std::size_t i = 0; i < samples.size(); i += stride) {
        if (is_finite(samples[i])) out.push_back(samples[i]);
    }
    std::sort(out.begin(), out.end());
    return out;
}

Levels measure(std::span<const double> samples) {
    Levels out;
    out.lowest = std::numeric_limits<double>::infinity();
    out.highest = -out.lowest;
    for (const double v : samples) {
        if (v != v) continue;
        ++out.defined;
        out.lowest = std::min(out.lowest, v);
        out.highest = std::max(out.highest, v);
    }
    out.undefined = samples.size() - out.defined;
    if (out.defined == 0) out.lowest = out.highest = 0;
    return out;
}

bool has_both_signs(const Levels& levels) { return levels.lowest < 0 && levels.highest >= 0; }

}  // namespace

double Step::times(std::int64_t k) const { return decimal(k * mantissa, exponent); }

Step round_step(double size) {
    Step step{1, decimal_exponent(size)};
    for (const int mantissa : {1, 2, 5}) {
        step.mantissa = mantissa;
        if (step.times(1) >= size) return step;
    }
    return {1, step.exponent + 1};
}

Ticks round_ticks(double low, double high, int count) {
    Ticks out;
    const double span = high - low;
    if (!(low < high) || !is_finite(span)) return out;
    if (span < (std::fabs(low) + std::fabs(high)) * 0x1p-40 || span < 1e-290) return out;
    out.step = round_step(span / count);
    const double size = out.step.times(1);
    const auto first = static_cast<std::int64_t>(std::ceil(low / size)) - 1;
    const auto last = static_cast<std::int64_t>(std::floor(high / size)) + 1;
    for (std::int64_t k = first; k <= last; ++k) {
        const double v = out.step.times(k);
        if (v >= low && v <= high) out.values.push_back(v);
    }
    return out;
}

Labels tick_labels(const Ticks& ticks) {
    Labels out;
    double largest = 0;
    for (const double v : ticks.values) largest = std::max(largest, std::fabs(v));
    const bool plain = largest == 0 || (largest < 1e6 && ticks.step.exponent >= -5);
    const int common = plain ? 0 : decimal_exponent(largest);
    const int decimals = std::max(0, common - ticks.step.exponent);
    for (const double v : ticks.values)
        out.texts.push_back(typeset(fmt::format("{:.{}f}", plain ? v : v / decimal(1, common), decimals)));
    if (!plain) out.factor = factor_text(common);
    return out;
}

Labels number_labels(std::span<const double> values) {
    Labels out;
    for (const double v : values) out.texts.push_back(typeset(fmt::format("{:.6g}", v)));
    return out;
}

Levels choose_levels(std::span<const double> samples, int count) {
    Levels out = measure(samples);
    const std::vector<double> typical = typical_samples(samples);
    out.values = {0};
    if (typical.empty()) return out;
    const std::size_t tail = typical.size() / 50;
    double low = typical[tail], high = typical[typical.size() - 1 - tail];
    if (!(low < high)) {
        low = typical.front();
        high = typical.back();
    }
    if (has_both_signs(out)) {
        low = std::min(low, 0.0);
        high = std::max(high, 0.0);
    }
    // Round steps lie a factor of 2 or 2.5 apart: up to 7/5 of the wish keeps the number near to it.
    Ticks ticks = round_ticks(low, high, count + 2 * count / 5);
    if (ticks.values.empty()) return out;
    out.step = ticks.step;
    out.values = std::move(ticks.values);
    return out;
}

Levels given_levels(std::span<const double> samples, std::vector<double> values) {
    Levels out = measure(samples);
    if (has_both_signs(out)) values.push_back(0);
    for (double& v : values) v += 0.0;  // -0 is 0
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    out.values = std::move(values);
    out.uniform = false;
    return out;
}

}  // namespace frep::drawing
