// Implementation of pov_operations.h. Formulas: field/kernels, where their sources stand.
#include "frep/lang/pov_operations.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace frep::lang {

namespace {

/// How an operation is written: {0}, {1} ... stand for its arguments.
struct Pattern {
    Op op;
    const char* text;
};

// POV-Ray's select(a, b, c) is b for a < 0, else c; select(a, b, c, d) tells 0 (c) from a > 0 (d).
constexpr std::array patterns{
    Pattern{Op::add, "({0}+{1})"},
    Pattern{Op::sub, "({0}-{1})"},
    Pattern{Op::mul, "({0}*{1})"},
    Pattern{Op::div, "({0}/{1})"},
    Pattern{Op::neg, "(-{0})"},
    Pattern{Op::square, "Frep_square({0})"},
    Pattern{Op::sqrt, "sqrt(max(0,{0}))"},
    Pattern{Op::abs, "abs({0})"},
    Pattern{Op::sign, "select({0},-1,0,1)"},
    Pattern{Op::min, "min({0},{1})"},
    Pattern{Op::max, "max({0},{1})"},
    Pattern{Op::hypot, "Frep_hypot({0},{1})"},
    Pattern{Op::floor, "floor({0})"},
    Pattern{Op::ceil, "ceil({0})"},
    Pattern{Op::trunc, "int({0})"},
    Pattern{Op::round, "floor({0}+0.5)"},
    Pattern{Op::remainder, "mod({0},{1})"},
    Pattern{Op::exp, "exp({0})"},
    Pattern{Op::log, "ln(max(1e-300,{0}))"},
    Pattern{Op::log10, "log(max(1e-300,{0}))"},
    Pattern{Op::sin, "sin({0})"},
    Pattern{Op::cos, "cos({0})"},
    Pattern{Op::tan, "tan({0})"},
    Pattern{Op::asin, "asin(max(-1,min(1,{0})))"},
    Pattern{Op::acos, "acos(max(-1,min(1,{0})))"},
    Pattern{Op::atan, "atan({0})"},
    Pattern{Op::atan2, "atan2({0},{1})"},
    Pattern{Op::sinh, "sinh({0})"},
    Pattern{Op::cosh, "cosh({0})"},
    Pattern{Op::tanh, "tanh({0})"},
    Pattern{Op::pow, "pow({0},{1})"},
    Pattern{Op::truth, "Frep_truth({0})"},
    Pattern{Op::logical_not, "(1-Frep_truth({0}))"},
    Pattern{Op::logical_and, "min(Frep_truth({0}),Frep_truth({1}))"},
    Pattern{Op::logical_or, "max(Frep_truth({0}),Frep_truth({1}))"},
    Pattern{Op::less, "select({0}-{1},1,0)"},
    Pattern{Op::less_equal, "select({1}-{0},0,1)"},
    Pattern{Op::equal, "select(abs({0}-{1})-1e-6,1,0)"},
    Pattern{Op::select, "select(abs({0})-1e-6,{2},{1})"},
    Pattern{Op::r_and, "Frep_and({0},{1})"},
    Pattern{Op::r_or, "Frep_or({0},{1})"},
    Pattern{Op::r_alpha_and, "Frep_alpha({0},{1},{2},-1)"},
    Pattern{Op::r_alpha_or, "Frep_alpha({0},{1},{2},1)"},
    Pattern{Op::r0m_and, "(Frep_and({0},{1})*pow(Frep_hypot({0},{1}),{2}))"},
    Pattern{Op::r0m_or, "(Frep_or({0},{1})*pow(Frep_hypot({0},{1}),{2}))"},
    Pattern{Op::rp_and, "({0}+{1}-Frep_norm({0},{1},{2}))"},
    Pattern{Op::rp_or, "({0}+{1}+Frep_norm({0},{1},{2}))"},
    Pattern{Op::blend_uni, "Frep_blend({0},{1},{2},{3},{4})"},
    Pattern{Op::blend_int, "(-Frep_blend(-{0},-{1},-{2},{3},{4}))"},
    Pattern{Op::point_uni, "Frep_point({0},{1},{2},{3},{4})"},
    Pattern{Op::point_int, "(-Frep_point(-{0},-{1},-{2},{3},{4}))"},
    Pattern{Op::bounded_uni, "Frep_bounded({0},{1},{2},{3},{4},{5},{6})"},
    Pattern{Op::bounded_int, "(-Frep_bounded(-{0},-{1},{2},-{3},{4},{5},{6}))"},
    Pattern{Op::sardf_blend, "Frep_fillet({0},{1},{2})"},
};

struct Segment {
    double begin[3], along[3], length;
};

Segment segment_at(std::span<const double> data) {
    Segment out{};
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        out.begin[i] = data[i];
        out.along[i] = data[i + 3] - data[i];
        square += out.along[i] * out.along[i];
    }
    out.length = std::sqrt(square);
    for (double& a : out.along) a = out.length > 0 ? a / out.length : 0;
    return out;
}

std::string segment_term(const Segment& s, const std::string& slope) {
    std::string out = "Frep_segment(px,py,pz";
    for (const double v : s.begin) out += "," + pov_number(v);
    for (const double v : s.along) out += "," + pov_number(v);
    return out + fmt::format(",{},{})", pov_number(s.length), slope);
}

/// One term a point: its function is called with the point and the numbers of the item.
std::string point_terms(std::string_view function, std::span<const double> data, std::size_t width,
                        std::size_t size_at, double least_size) {
    std::string out;
    for (std::size_t i = 0; i + width <= data.size(); i += width) {
        if (size_at < width && data[i + size_at] <= least_size) continue;
        out += fmt::format("{}{}(px,py,pz", out.empty() ? "" : "+\n ", function);
        for (std::size_t k = 0; k < width; ++k) out += "," + pov_number(data[i + k]);
        out += ")";
    }
    return out.empty() ? "0" : out;
}

}  // namespace

std::string_view pov_prelude() {
    return R"(#declare Frep_square = function(a) { a*a }
#declare Frep_hypot = function(a,b) { sqrt(a*a+b*b) }
#declare Frep_truth = function(a) { select(abs(a)-1e-6,0,1) }
#declare Frep_and = function(a,b) { a+b-sqrt(a*a+b*b) }
#declare Frep_or = function(a,b) { a+b+sqrt(a*a+b*b) }
#declare Frep_alpha = function(a,b,k,s) { (a+b+s*sqrt(max(0,a*a+b*b-2*k*a*b)))/(1+k) }
#declare Frep_norm = function(a,b,p) { pow(pow(abs(a),p)+pow(abs(b),p),1/p) }
#declare Frep_bell = function(a) { a*a*a/(2-a) }
#declare Frep_blend = function(f1,f2,a0,a1,a2) { Frep_or(f1,f2)+select(abs(a0*a1*a2),0,0,a0/(1+(f1/a1)*(f1/a1)+(f2/a2)*(f2/a2))) }
#declare Frep_within = function(a,a0) { select(a-1,a0*Frep_bell(1-a),0) }
#declare Frep_point = function(f1,f2,a0,a1,a2) { Frep_or(f1,f2)+select(abs(a0*a1*a2),0,0,Frep_within((f1/a1)*(f1/a1)+(f2/a2)*(f2/a2),a0)) }
#declare Frep_share = function(a,b,c) { select(a*a+b*b+c*c,1,1,c*c/(a*a+b*b+c*c)) }
#declare Frep_bounded = function(f1,f2,f3,a0,a1,a2,a3) { Frep_or(f1,f2)+select(-f3,select(abs(a0*a1*a2*a3),0,0,a0*Frep_bell(Frep_share(f1/a1,f2/a2,f3/a3))),0) }
#declare Frep_fillet = function(a,b,r) { select(r-abs(a-b),min(a,b),0.5*(a+b-2*r+sqrt(max(0,2*r*r-(a-b)*(a-b))))) }
#declare Frep_distance2 = function(a,b,c) { a*a+b*b+c*c }
#declare Frep_blobby = function(x,y,z,x0,y0,z0,a,b) { b*exp(-a*Frep_distance2(x-x0,y-y0,z-z0)) }
#declare Frep_metaball_bell = function(q,b) { b*select(q-1/3,1-3*q*q,select(q-1,1.5*(1-q)*(1-q),0)) }
#declare Frep_metaball = function(x,y,z,x0,y0,z0,b,d) { Frep_metaball_bell(sqrt(Frep_distance2(x-x0,y-y0,z-z0))/d,b) }
#declare Frep_soft_bell = function(q) { select(1-q,0,1-q*(22/9-q*(17/9-q*4/9))) }
#declare Frep_soft = function(x,y,z,x0,y0,z0,d) { Frep_soft_bell(Frep_distance2(x-x0,y-y0,z-z0)/(d*d)) }
#declare Frep_fitted = function(x,y,z,x0,y0,z0,f0,s) { f0/(1+Frep_distance2(x-x0,y-y0,z-z0)/(s*s)) }
#declare Frep_cauchy = function(x,y,z,x0,y0,z0,s) { 1/Frep_square(1+s*s*Frep_distance2(x-x0,y-y0,z-z0)) }
#declare Frep_line_at = function(a,l,s,p2,p) { (a/(p2+s*s*a*a)+(l-a)/(p2+s*s*(l-a)*(l-a))+(atan(s*a/p)+atan(s*(l-a)/p))/(s*p))/(2*p2) }
#declare Frep_line_p2 = function(a,l,s,p2) { select(abs(s),l,l,Frep_line_at(a,l,s,p2,sqrt(p2))) }
#declare Frep_line = function(x,y,z,ux,uy,uz,l,s) { Frep_line_p2(x*ux+y*uy+z*uz,l,s,1+s*s*Frep_distance2(y*uz-z*uy,z*ux-x*uz,x*uy-y*ux)) }
#declare Frep_segment = function(x,y,z,x0,y0,z0,ux,uy,uz,l,s) { Frep_line(x-x0,y-y0,z-z0,ux,uy,uz,l,s) }
)";
}

std::string pov_number(double value) {
    return value < 0 ? fmt::format("({})", value) : fmt::format("{}", value + 0.0);
}

std::optional<std::string> pov_operation(Op op, std::span<const std::string> arguments) {
    for (const Pattern& pattern : patterns) {
        if (pattern.op != op) continue;
        std::string out;
        for (const char* at = pattern.text; *at != '\0'; ++at) {
            if (*at != '{') {
                out.push_back(*at);
                continue;
            }
            const auto index = static_cast<std::size_t>(at[1] - '0');
            if (index < arguments.size()) out += arguments[index];
            at += 2;
        }
        return out;
    }
    return std::nullopt;
}

std::optional<std::string> pov_block(Op op, std::span<const double> data) {
    constexpr std::size_t always = 99;
    if (op == Op::blobby) return point_terms("Frep_blobby", data, 5, always, 0);
    if (op == Op::metaball) return point_terms("Frep_metaball", data, 5, 4, 0);
    if (op == Op::soft) return point_terms("Frep_soft", data, 4, 3, 0);
    if (op == Op::fitted_blob) return point_terms("Frep_fitted", data, 5, 4, 1e-6);
    if (op == Op::conv_point) return point_terms("Frep_cauchy", data, 4, always, 0);
    std::string out = "0";
    if (op == Op::conv_line) {
        for (std::size_t i = 0; i + 7 <= data.size(); i += 7)
            out += "+\n " + segment_term(segment_at(data.subspan(i, 6)), pov_number(data[i + 6]));
        return out;
    }
    if (op != Op::conv_line_clamped) return std::nullopt;
    // the running sum is clamped to 1 after each term; terms are positive, so once at the end does
    for (std::size_t i = 0; i + 6 <= data.size(); i += 6)
        out += "+\n " + segment_term(segment_at(data.subspan(i, 6)), "ps");
    return "min(1," + out + ")";
}

}  // namespace frep::lang
