// Implementation of mesh_print.h.
#include "mesh_print.h"

#include <fmt/format.h>

#include "mesh_report.h"
#include "values.h"

namespace frep::cli {

namespace {

Json width_json(const WidthReport& widths) {
    Json out = {{"smallest_mm", nullptr}, {"from", nullptr}, {"to", nullptr}};
    if (widths.smallest) {
        out["smallest_mm"] = json_number(widths.smallest->length_mm);
        out["from"] = point_json(widths.smallest->from);
        out["to"] = point_json(widths.smallest->to);
    }
    out["p01_mm"] = json_number(widths.p01_mm);
    out["median_mm"] = json_number(widths.median_mm);
    out["measured_area_mm2"] = json_number(widths.measured_area_mm2);
    return out;
}

std::string width_line(std::string_view what, const WidthReport& widths) {
    if (!widths.smallest) return fmt::format("  {:<10} none found\n", what);
    const Vec3 p = widths.smallest->from;
    return fmt::format("  {:<10} {:.4g} mm at ({:.4g}, {:.4g}, {:.4g}); 1 % below {:.4g}, median {:.4g}\n",
                       what, widths.smallest->length_mm, p.x, p.y, p.z, widths.p01_mm, widths.median_mm);
}

}  // namespace

Result<PrintReport> run_print_check(const Mesh& mesh, const MeshPlan& plan, const LengthUnit& unit,
                                    const Job& job) {
    PrintCheckOptions options;
    options.unit = unit;
    options.overhang_angle = plan.overhang;
    options.min_wall_mm = plan.min_wall.value_or(0) * unit.metres * 1000;
    return print_check(mesh, options, job);
}

Json print_json(const PrintReport& report, const MeshPlan& plan) {
    Json out = {{"mm_per_unit", report.mm_per_unit}, {"size_mm", point_json(report.size_mm)}};
    out["walls"] = width_json(report.walls);
    if (plan.min_wall) {
        out["walls"]["limit_mm"] = json_number(*plan.min_wall * report.mm_per_unit);
        out["walls"]["below_limit_area_mm2"] = json_number(report.walls.below_limit_area_mm2);
    }
    out["gaps"] = width_json(report.gaps);
    out["overhang"] = {{"limit_deg", plan.overhang},
                       {"area_mm2", json_number(report.overhang.area_mm2)},
                       {"share", json_number(report.overhang.share)},
                       {"steepest_deg", json_number(report.overhang.steepest)},
                       {"at", report.overhang.worst ? point_json(*report.overhang.worst) : Json(nullptr)}};
    out["stand"] = {
        {"contact_area_mm2", json_number(report.stand.contact_area_mm2)},
        {"margin_mm", report.stand.margin_mm ? json_number(*report.stand.margin_mm) : Json(nullptr)},
        {"stable", report.stand.stable}};
    out["smallest_component_mm"] =
        report.smallest_component ? json_number(report.smallest_component->size_mm) : Json(nullptr);
    out["components"] = report.components;
    out["samples"] = report.samples;
    return out;
}

std::string print_text(const PrintReport& report, const MeshPlan& plan) {
    const Vec3 s = report.size_mm;
    std::string out = "print check\n";
    out += fmt::format("  {:<10} {:.4g} x {:.4g} x {:.4g} mm\n", "size", s.x, s.y, s.z);
    out += width_line("walls", report.walls);
    out += width_line("gaps", report.gaps);
    out += fmt::format("  {:<10} {:.4g} mm2 beyond {:.4g} degrees ({:.1f} % of the surface)\n", "overhang",
                       report.overhang.area_mm2, plan.overhang, 100 * report.overhang.share);
    out += fmt::format("  {:<10} on {:.4g} mm2, {}\n", "stand", report.stand.contact_area_mm2,
                       report.stand.stable ? "stable" : "not stable");
    out += fmt::format("  {:<10} {}", "parts", report.components);
    if (report.smallest_component)
        out += fmt::format(", the smallest {:.4g} mm long", report.smallest_component->size_mm);
    return out + "\n";
}

std::vector<std::string> broken_walls(const PrintReport& report, const MeshPlan& plan) {
    if (!plan.min_wall || !report.walls.smallest) return {};
    const double limit = *plan.min_wall * report.mm_per_unit;
    if (report.walls.smallest->length_mm >= limit) return {};
    const Vec3 p = report.walls.smallest->from;
    return {
        fmt::format("--min-wall: a wall of {:.4g} mm at ({:.4g}, {:.4g}, {:.4g}) is thinner than {:.4g} mm",
                    report.walls.smallest->length_mm, p.x, p.y, p.z, limit)};
}

}  // namespace frep::cli
