// Implementation of blend_diagnostics.h.
#include "frep/blend_diagnostics.h"

#include <cctype>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "frep/lang/codes.h"

namespace frep {

namespace {

/// True when the text at this place begins with `name`, given in lower case.
bool calls(const Source& source, Span span, std::string_view name) {
    const std::string_view text = source.text(span);
    if (text.size() < name.size()) return false;
    for (std::size_t i = 0; i < name.size(); ++i)
        if (std::tolower(static_cast<unsigned char>(text[i])) != name[i]) return false;
    return true;
}

std::string point_text(const Vec3& p, const std::array<bool, 3>& axes) {
    const std::array<double, 3> all{p.x, p.y, p.z};
    std::string out;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (axes[axis]) out += fmt::format("{}{:.4g}", out.empty() ? "(" : ", ", all[axis]);
    return out + ")";
}

lang::Code code_of(BlendFlaw flaw) {
    switch (flaw) {
        case BlendFlaw::never_acts:
            return lang::Code::blend_changes_nothing;
        case BlendFlaw::second_place:
            return lang::Code::blend_at_second_place;
        case BlendFlaw::through_wall:
            return lang::Code::blend_through_wall;
        case BlendFlaw::unseen:
        case BlendFlaw::coarse:
            break;
    }
    return lang::Code::blend_not_judged;
}

}  // namespace

std::optional<Diagnostic> blend_diagnostic(const BlendFinding& found, const Source& source,
                                           const std::array<bool, 3>& axes) {
    const lang::CodeInfo& row = lang::info(code_of(found.flaw));
    Diagnostic d;
    d.code = row.code;
    d.severity = row.severity;
    d.span = found.origin;
    const std::string place = point_text(found.place, axes), first = point_text(found.first_place, axes);
    switch (found.flaw) {
        case BlendFlaw::never_acts:
            d.message = "this blend changes nothing: the shape is that of the plain set operation";
            d.label = "never reaches the surface";
            d.help =
                "the two surfaces do not meet where it acts, or what it adds lies inside the rest of the "
                "model; check the bounding solid and the extents";
            break;
        case BlendFlaw::second_place:
            if (!calls(source, found.origin, "hfcontrolblend")) return std::nullopt;
            d.message = fmt::format("this blend also acts at {}, apart from {}", place, first);
            d.label = "acts at a second place";
            d.help =
                "a blend between control points acts wherever the two surfaces are that near; "
                "hfBoundedBlendUni and its relatives choose one place by a bounding solid";
            break;
        case BlendFlaw::through_wall:
            d.message = fmt::format("the bounding solid of this blend reaches another surface at {}", place);
            d.label = "moves a surface away from the joint";
            d.help = fmt::format(
                "the joint is near {}; make the bounding solid smaller, cut it with the outer surface, "
                "or blend before the hollow is taken out",
                first);
            break;
        case BlendFlaw::unseen:
            d.message = fmt::format(
                "this blend could not be judged: none of {} samples along the box is changed by it, and "
                "there "
                "is no proof that nothing is",
                found.samples);
            d.label = "changes nothing that was seen";
            d.help = "what it adds may be very thin, or nothing; --bounds with a smaller box looks closer";
            break;
        case BlendFlaw::coarse:
            d.message = fmt::format(
                "this blend could only be judged with {} samples along the box: it acts, and nothing wrong "
                "was "
                "seen",
                found.samples);
            d.label = "needs too much work for more";
            d.help = "--bounds with a smaller box around the blend looks closer";
            break;
    }
    return d;
}

}  // namespace frep
