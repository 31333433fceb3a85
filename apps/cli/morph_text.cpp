// Implementation of morph_text.h.
#include "morph_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "values.h"

namespace frep::cli {

namespace {

/// Before the names of the objects and parameters of the two models.
constexpr const char* prefixes[2] = {"first_", "second_"};

class MorphWriter {
  public:
    explicit MorphWriter(const MorphPlan& plan) : plan_(plan) {}

    std::string text(const std::string& a0) const {
        const MorphBlend& b = plan_.blend;
        const std::size_t n = plan_.coordinates();
        const std::size_t counts[2] = {static_cast<std::size_t>(plan_.parts[0]->header().parameters()),
                                       static_cast<std::size_t>(plan_.parts[1]->header().parameters())};
        std::string out = header();
        for (std::size_t k = 0; k < 2; ++k) {
            const Model& model = plan_.parts[k]->model;
            out += fmt::format("-- Objects of the {} model.\n", k == 0 ? "first" : "second");
            out += lang::with_renamed_objects(model.source(), model.program(), prefixes[k]);
            out += "\n\n";
        }
        const bool colored = is_colored();
        out += fmt::format("my_model(x[{}], a[{}]{})\n{{\n", n + 1,
                           std::max<std::size_t>(1, plan_.parameter_count() + (a0.starts_with('a') ? 1 : 0)),
                           colored ? ", s[3]" : "");
        out += fmt::format("  array p[{}], u[{}], v[{}]{};\n", n, std::max<std::size_t>(1, counts[0]),
                           std::max<std::size_t>(1, counts[1]), colored ? attribute_arrays() : "");
        out +=
            copied("p", "x", n, 0) + copied("u", "a", counts[0], 0) + copied("v", "a", counts[1], counts[0]);
        if (counts[0] == 0) out += "  u[1] = 0;\n";
        if (counts[1] == 0) out += "  v[1] = 0;\n";
        for (std::size_t k = 0; k < 2; ++k) out += call_text(k, colored);
        out += time_text(n + 1);
        if (colored) out += blended_colors();
        out += plan_.plain
                   ? fmt::format("  my_model = hfSpaceTimeBlend(g1, g2, t, 0, 1, 10, {}, {}, {}, {});\n}}\n",
                                 a0, number_text(b.a1), number_text(b.a2), number_text(b.a3))
                   : fmt::format(
                         "  my_model = hfSpaceTimeBlendSmooth(g1, g2, t, 0, 1, 10, {}, {}, {}, {}, {}, "
                         "{});\n}}\n",
                         a0, number_text(b.a1), number_text(b.a2), number_text(b.a3), number_text(b.b0),
                         number_text(b.c));
        return out;
    }

  private:
    /// `--@ param` lines for the parameters of both, named after the model, with the values used here.
    std::string parameter_lines() const {
        std::string out;
        std::size_t index = 1;
        for (std::size_t k = 0; k < 2; ++k) {
            const PreparedModel& part = *plan_.parts[k];
            for (int i = 0; i < part.header().parameters(); ++i, ++index) {
                const double value = part.field().parameters[static_cast<std::size_t>(i)];
                const lang::ParameterAnnotation* note = nullptr;
                if (part.model.find_object({}) == part.object)
                    for (const auto& row : part.model.program().annotations.parameters)
                        if (row.index == i + 1) note = &row;
                if (!note && value == 0) continue;
                out += fmt::format("--@ param a[{}] {}{}", index, prefixes[k],
                                   note ? note->name : fmt::format("a{}", i + 1));
                if (note && note->has_range && value >= note->low && value <= note->high)
                    out += fmt::format(" {}..{}", number_text(note->low), number_text(note->high));
                out += fmt::format(" default {}", number_text(value));
                if (note && !note->description.empty()) out += fmt::format(" \"{}\"", note->description);
                out += "\n";
            }
        }
        return out;
    }

    /// Assignments that fill `array` with items of `from`, beginning after `skip`.
    static std::string copied(const std::string& array, const std::string& from, std::size_t count,
                              std::size_t skip) {
        std::string out;
        for (std::size_t i = 1; i <= count; ++i)
            out += fmt::format("  {}[{}] = {}[{}];\n", array, i, from, i + skip);
        return out;
    }

    static std::string system_line(const shapes::SetSystem& system) {
        using Kind = shapes::SetSystem::Kind;
        switch (system.kind) {
            case Kind::r0:
                break;
            case Kind::min_max:
                return "--@ set-operations min-max\n";
            case Kind::r_alpha:
                return fmt::format("--@ set-operations r-alpha {}\n", number_text(system.parameter));
            case Kind::r0m:
                return fmt::format("--@ set-operations r0m {}\n", number_text(system.parameter));
            case Kind::rp:
                return fmt::format("--@ set-operations rp {}\n", number_text(system.parameter));
        }
        return {};
    }

    std::string header() const {
        const auto title = [](const PreparedModel& part) {
            const std::string& given = part.model.program().annotations.title;
            return given.empty() ? part.header().written_name : given;
        };
        const Box3 box = plan_.box;
        const double low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
        std::string out = fmt::format("--@ title    {} to {}\n--@ bounds  ", title(*plan_.parts[0]),
                                      title(*plan_.parts[1]));
        for (std::size_t a = 0; a < plan_.coordinates(); ++a) {
            const double margin = 0.1 * (high[a] - low[a]);
            out += fmt::format(" {:.4g} {:.4g} ", low[a] - margin, high[a] + margin);
        }
        out += fmt::format(" {} {}\n", number_text(plan_.from), number_text(plan_.to));
        out += system_line(plan_.parts[0]->model.program().annotations.set_operations);
        out += parameter_lines();
        return out +
               "-- Space-time bounded blending of two models; the last coordinate is time. Made by frep "
               "morph.\n\n";
    }

    /// The color of both, if they have any: from their attributes, or from their annotations.
    bool is_colored() const {
        return std::all_of(plan_.parts.begin(), plan_.parts.end(), [](const PreparedModel* part) {
            return has_colors(*part) || annotated_color(part->model);
        });
    }
    std::string color_text(std::size_t k) const {
        if (has_colors(*plan_.parts[k])) return {};
        const Color color = *annotated_color(plan_.parts[k]->model);
        return fmt::format("  c{}[1] = {};\n  c{}[2] = {};\n  c{}[3] = {};\n", k + 1, number_text(color.r),
                           k + 1, number_text(color.g), k + 1, number_text(color.b));
    }

    /// The blend's time, from -10 to 10.
    std::string time_text(std::size_t index) const {
        const double middle = 0.5 * (plan_.from + plan_.to),
                     scale = 2 * MorphBlend::span / (plan_.to - plan_.from);
        std::string time = fmt::format("x[{}]", index);
        if (middle != 0)
            time = fmt::format("({} {} {})", time, middle > 0 ? "-" : "+", number_text(std::abs(middle)));
        if (scale != 1) time = fmt::format("{}*{}", number_text(scale), time);
        return fmt::format("  t = {};\n", time);
    }

    std::string attribute_arrays() const {
        std::string out;
        for (std::size_t k = 0; k < 2; ++k)
            out += fmt::format(", c{}[{}]", k + 1,
                               std::max<std::size_t>(3, plan_.parts[k]->field().attributes.size()));
        return out;
    }
    /// g1 = 0.5*first_name(p, u); with attributes the three of the color.
    std::string call_text(std::size_t k, bool colored) const {
        const char* const values = k == 0 ? "u" : "v";
        const std::string name = std::string(prefixes[k]) + plan_.parts[k]->header().written_name;
        std::string out;
        const bool with_colors = colored && has_colors(*plan_.parts[k]);
        if (with_colors)
            for (std::size_t i = 1; i <= plan_.parts[k]->field().attributes.size(); ++i)
                out += fmt::format("  c{}[{}] = 0;\n", k + 1, i);
        if (colored) out += color_text(k);
        const std::string factor = plan_.factors[k] == 1 ? "" : number_text(plan_.factors[k]) + "*";
        return out + fmt::format("  g{} = {}{}(p, {}{});\n", k + 1, factor, name, values,
                                 with_colors ? fmt::format(", c{}", k + 1) : "");
    }
    static std::string blended_colors() {
        return "  f1 = hfHalfCylinderBefore(g1, t, 0);\n"
               "  f2 = hfHalfCylinderAfter(g2, t, 1);\n"
               "  mixed = hfA_SpaceTimeColor(f1, f2, s, c1, c2);\n";
    }

    const MorphPlan& plan_;
};

}  // namespace

std::size_t MorphPlan::parameter_count() const {
    return static_cast<std::size_t>(parts[0]->header().parameters() + parts[1]->header().parameters());
}

std::string morph_text(const MorphPlan& plan, const std::string& a0) { return MorphWriter(plan).text(a0); }

}  // namespace frep::cli
