// The IEEE 1788 vectors of the ITF1788 collection (data in $FREP_SHARED/itf1788, never copied here): our
// interval must contain the expected one, and where both are finite and the operation means the same, end no
// more than 8 ulp outside it. Where our semantics differ: a divisor with 0 gives the whole line; tan across a
// pole likewise; sin and cos beyond 2^20 give [-1,1]; the origin has an angle in atan2; 0 to a
// negative power is +inf; pow follows rule 8 of
// numerics.md, so that bases below 1e-6 are skipped and integer exponents are judged as powers by a chain;
// undefined parts are marked by maybe_undefined rather than cut off.
#include <doctest/doctest.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <vector>

#include "oracle.h"

using frep::math::Interval;
namespace fm = frep::math;

namespace {

using Operation = std::function<Interval(const std::vector<Interval>&)>;

struct Row {
    Operation run;
    std::size_t arguments;
    int slack;  // ulps allowed outside; -1: containment only
};

std::map<std::string, Row> operations() {
    std::map<std::string, Row> table;
    const auto one = [&](const char* name, Interval (*f)(Interval), int slack) {
        table[name] = {[f](const std::vector<Interval>& a) { return f(a[0]); }, 1, slack};
    };
    const auto two = [&](const char* name, Interval (*f)(Interval, Interval), int slack) {
        table[name] = {[f](const std::vector<Interval>& a) { return f(a[0], a[1]); }, 2, slack};
    };
    one(
        "pos", [](Interval a) { return a; }, 0);
    one(
        "neg", [](Interval a) { return -a; }, 0);
    one(
        "recip", [](Interval a) { return Interval(1.0) / a; }, 8);
    two(
        "add", [](Interval a, Interval b) { return a + b; }, 2);
    two(
        "sub", [](Interval a, Interval b) { return a - b; }, 2);
    two(
        "mul", [](Interval a, Interval b) { return a * b; }, 2);
    two(
        "div", [](Interval a, Interval b) { return a / b; }, 2);
    two("convexHull", fm::hull, 0);
    two("min", fm::min, 0);
    two("max", fm::max, 0);
    two("hypot", fm::hypot, 8);
    two("atan2", fm::atan2, 8);
    two("pow", fm::pow, 8);
    const std::pair<const char*, Interval (*)(Interval)> exact[] = {
        {"abs", fm::abs}, {"sign", fm::sign}, {"floor", fm::floor}, {"ceil", fm::ceil}, {"trunc", fm::trunc}};
    for (const auto& [name, f] : exact) one(name, f, 0);
    one("sqr", fm::square, 2);
    one("sqrt", fm::sqrt, 2);
    const std::pair<const char*, Interval (*)(Interval)> kernels[] = {
        {"exp", fm::exp},   {"log", fm::log},   {"log10", fm::log10}, {"sin", fm::sin},
        {"cos", fm::cos},   {"tan", fm::tan},   {"asin", fm::asin},   {"acos", fm::acos},
        {"atan", fm::atan}, {"sinh", fm::sinh}, {"cosh", fm::cosh},   {"tanh", fm::tanh}};
    for (const auto& [name, f] : kernels) one(name, f, 8);
    table["pown"] = {[](const std::vector<Interval>& a) { return fm::powi(a[0], static_cast<int>(a[1].lo)); },
                     2, -1};
    return table;
}

/// Reads "[a,b]", "[a]", "[empty]", "[entire]" or a bare number; false for anything else.
bool read_interval(std::istringstream& in, Interval& out) {
    in >> std::ws;
    if (in.peek() != '[') {
        std::string word;
        in >> word;
        char* end = nullptr;
        const double x = std::strtod(word.c_str(), &end);
        out = Interval(x);
        return end != word.c_str() && *end == '\0';
    }
    std::string text;
    std::getline(in, text, ']');
    if (in.peek() == '_') {  // a decoration
        for (int c = in.peek(); std::isalnum(c) || c == '_'; c = in.peek()) in.get();
    }
    text = text.substr(1);
    if (text.find("empty") != std::string::npos) return out = Interval::empty(), true;
    if (text.find("entire") != std::string::npos) return out = Interval::entire(), true;
    if (text.find("nai") != std::string::npos) return false;
    const std::size_t comma = text.find(',');
    const double lo = std::strtod(text.c_str(), nullptr);
    const double hi = comma == std::string::npos ? lo : std::strtod(text.c_str() + comma + 1, nullptr);
    out = Interval(lo, hi);
    return true;
}

bool same_meaning(const std::string& name, const std::vector<Interval>& a) {
    if (name == "pown") return !(a[1].lo < 0.0 && a[0].contains(0.0));
    if (name == "div") return !a[1].contains(0.0);
    if (name == "recip") return !a[0].contains(0.0);
    if (name == "atan2") return !(a[0].contains(0.0) && a[1].contains(0.0));
    if (name == "pow") {
        return a[1].lo == a[1].hi && a[0].lo >= 1e-6 && std::floor(a[1].lo) != a[1].lo;
    }
    return true;
}

/// How many doubles `outer` lies outside `inner` at its worse end.
long places_outside(const Interval& outer, const Interval& inner) {
    const auto place = [](double x) {
        const auto b = static_cast<std::int64_t>(fm::to_bits(x));
        return b < 0 ? INT64_MIN - b : b;
    };
    return static_cast<long>(std::max(place(inner.lo) - place(outer.lo), place(outer.hi) - place(inner.hi)));
}

struct Tally {
    long run = 0, skipped = 0, tight = 0, wrong = 0;
};

void run_line(const std::map<std::string, Row>& table, const std::string& line, Tally& tally) {
    std::istringstream in(line);
    std::string name, equals;
    in >> name;
    const auto row = table.find(name);
    std::vector<Interval> a(row == table.end() ? 0 : row->second.arguments);
    bool good = row != table.end();
    for (Interval& x : a) good = good && read_interval(in, x);
    Interval expected;
    good = good && (in >> equals) && equals == "=" && read_interval(in, expected);
    if (good && name == "pow") {
        good = a[0].hi >= 1e-6 && !(a[0].lo < 1e-6 && a[1].lo <= 0.0);
    }
    if (!good) {
        ++tally.skipped;
        return;
    }
    ++tally.run;
    const Interval r = row->second.run(a);
    const bool contained = expected.is_empty() || (r.lo <= expected.lo && expected.hi <= r.hi);
    const bool finite = !expected.is_empty() && std::isfinite(expected.lo) && std::isfinite(expected.hi) &&
                        std::isfinite(r.lo) && std::isfinite(r.hi);
    bool tight = true;
    if (finite && row->second.slack >= 0 && same_meaning(name, a)) {
        ++tally.tight;
        tight = places_outside(r, expected) <= row->second.slack;
    }
    // An operation with an empty operand or no defined value is empty or marked.
    const bool marked = !expected.is_empty() || r.is_empty() || r.maybe_undefined || !same_meaning(name, a);
    if (contained && tight && marked) return;
    if (++tally.wrong <= 20) {
        std::printf("    %s gave [%a,%a]%d%s%s\n", line.c_str(), r.lo, r.hi, r.maybe_undefined,
                    contained ? "" : " not contained", tight ? "" : " not tight");
    }
}

}  // namespace

TEST_CASE("IEEE 1788 vectors") {
    const char* shared = std::getenv("FREP_SHARED");
    const std::string folder =
        (shared != nullptr ? std::string(shared) : std::string(FREP_SOURCE_DIR) + "/../shared") + "/itf1788/";
    const auto table = operations();
    int absent = 0;
    for (const char* file : {"atan2.itl", "c-xsc.itl", "fi_lib.itl", "libieeep1788_elem.itl"}) {
        std::ifstream in(folder + file);
        if (!in) {
            ++absent;
            continue;
        }
        Tally tally;
        bool comment = false;
        for (std::string line; std::getline(in, line);) {
            if (line.find("/*") != std::string::npos) comment = true;
            const bool ends = line.find("*/") != std::string::npos;
            const std::size_t semicolon = line.find(';');
            if (!comment && semicolon != std::string::npos && line.find("//") > semicolon) {
                std::string text = line.substr(0, semicolon);
                // "[a, b]" and "[a,b]" alike; a "=" stands alone.
                run_line(table, text, tally);
            }
            if (ends) comment = false;
        }
        std::printf("  %-22s %5ld run (%ld for tightness), %ld skipped, %ld wrong\n", file, tally.run,
                    tally.tight, tally.skipped, tally.wrong);
        INFO(file);
        CHECK(tally.wrong == 0);
        CHECK(tally.run > 0);
    }
    if (absent > 0) std::printf("skipped: %d (IEEE 1788 vectors absent in %s)\n", absent, folder.c_str());
}
