// Implementation of blend_check.h.
#include "frep/measure/blend_check.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "frep/base/parallel.h"
#include "frep/measure/blend_search.h"

namespace frep {

namespace {

using namespace measuring;

constexpr std::size_t most_findings = 4;
/// Samples along the longest side where nothing can be pruned.
constexpr std::uint32_t few_samples = 24;

/// A blend that cannot displace anything has an amount or an extent of 0: that is meant.
bool is_off(const Field& field, NodeId blend) {
    const auto arguments = field.graph->arguments(blend);
    for (std::size_t k = is_bounded_blend(field.graph->node(blend).op) ? 3 : 2; k < arguments.size(); ++k) {
        const auto value = field.graph->constant_value(arguments[k]);
        if (value && *value == 0) return true;
    }
    return false;
}

/// What is wrong with the blend that `finding` names, with what the search found.
std::vector<BlendFinding> judged(BlendFinding finding, BlendSearch& search, const BlendMap& map) {
    finding.samples = map.finest;
    if (map.never_acts) return {finding};
    if (!map.acts) {
        finding.flaw = BlendFlaw::unseen;
        return {finding};
    }
    std::vector<bool> is_unexpected(map.parts.size(), false);
    bool any_expected = true;
    if (is_point_blend(finding.op)) {
        finding.flaw = BlendFlaw::second_place;
        for (std::size_t p = 1; p < map.parts.size(); ++p) is_unexpected[p] = true;
    } else if (map.parts.size() > 1) {
        finding.flaw = BlendFlaw::through_wall;
        any_expected = false;
        for (std::size_t p = 0; p < map.parts.size(); ++p) {
            is_unexpected[p] = !search.touches_joint(map.parts[p]);
            any_expected = any_expected || !is_unexpected[p];
        }
    }
    std::vector<BlendFinding> out;
    for (std::size_t p = 0; any_expected && p < map.parts.size() && out.size() < most_findings; ++p) {
        if (!is_unexpected[p]) continue;
        const auto expected = std::find(is_unexpected.begin(), is_unexpected.end(), false);
        finding.place = search.most_changed(map.parts[p]);
        finding.first_place =
            search.most_changed(map.parts[static_cast<std::size_t>(expected - is_unexpected.begin())]);
        out.push_back(finding);
    }
    if (out.empty() && map.finest > 0 && map.finest < BlendSearch::enough_samples) {
        finding.flaw = BlendFlaw::coarse;
        out.push_back(finding);
    }
    return out;
}

/// True when the blend changes a sample of a coarse lattice.
Result<bool> changes_few_samples(const Field& change, const MeasuredBox& box, const EvaluatorOptions& options,
                                 const Job& job) {
    auto evaluator = make_evaluator(change, options);
    if (!evaluator) return evaluator.error();
    const double step = box.longest / few_samples;
    std::array<std::uint32_t, 3> count{1, 1, 1};
    for (const std::size_t axis : box.axes)
        count[axis] = std::max(
            1u, static_cast<std::uint32_t>(std::ceil((box.cell.high[axis] - box.cell.low[axis]) / step)));
    std::array<std::vector<double>, 3> columns;
    for (std::uint32_t k = 0; k < count[2] && !job.cancelled(); ++k) {
        for (std::vector<double>& column : columns) column.clear();
        for (std::uint32_t n = 0; n < count[0] * count[1]; ++n) {
            const std::array<std::uint32_t, 3> at{n % count[0], n / count[0], k};
            std::array<double, 3> p{};
            for (const std::size_t axis : box.axes) p[axis] = box.cell.low[axis] + step * (at[axis] + 0.5);
            for (std::size_t axis = 0; axis < 3; ++axis) columns[axis].push_back(p[axis]);
        }
        std::vector<double> values(columns[0].size());
        const double* points[] = {columns[0].data(), columns[1].data(), columns[2].data()};
        double* out[] = {values.data()};
        (*evaluator)->values(points, values.size(), out);
        if (std::any_of(values.begin(), values.end(), [](double v) { return v > 0; })) return true;
    }
    return false;
}

/// The findings for one blend.
Result<std::vector<BlendFinding>> findings_of(const Field& field, NodeId blend, const MeasuredBox& box,
                                              const EvaluatorOptions& options, const Job& job) {
    BlendFinding finding;
    finding.node = blend;
    finding.op = field.graph->node(blend).op;
    finding.origin = field.graph->origin(blend);
    const BlendFields fields = blend_fields(field, blend);
    auto change = make_clause_tape(fields.change), joint = make_clause_tape(fields.joint);
    if (!change || !joint) {
        const auto acts = changes_few_samples(fields.change, box, options, job);
        if (!acts) return acts.error();
        finding.samples = few_samples;
        const bool is_judged = *acts && !is_point_blend(finding.op) && !is_bounded_blend(finding.op);
        finding.flaw = *acts ? BlendFlaw::coarse : BlendFlaw::unseen;
        return is_judged ? std::vector<BlendFinding>{} : std::vector{finding};
    }
    BlendSearch search(std::move(*change), std::move(*joint), box);
    const bool is_local = is_point_blend(finding.op) || is_bounded_blend(finding.op);
    const BlendMap map = search.run(is_local, job);
    return job.cancelled() ? std::vector<BlendFinding>{} : judged(finding, search, map);
}

}  // namespace

Result<std::vector<BlendFinding>> check_blends(const Field& field, const BlendCheckOptions& options,
                                               const Job& job) {
    const auto box = measured_box(options.bounds, options.axes);
    if (!box) return box.error();
    std::vector<NodeId> blends;
    const NodeId roots[] = {field.value};
    const std::vector<bool> needed = reachable(*field.graph, roots);
    for (NodeId id = 0; id < field.graph->size() && id < needed.size(); ++id)
        if (needed[id] && is_blend(field.graph->node(id).op) && !is_off(field, id)) blends.push_back(id);
    std::vector<Result<std::vector<BlendFinding>>> found(blends.size(), std::vector<BlendFinding>{});
    parallel_for(job, blends.size(), [&](std::size_t i) {
        found[i] = findings_of(field, blends[i], *box, options.evaluator, job);
    });
    if (job.cancelled()) return Error{ErrorKind::cancelled, "cancelled"};
    // a place of the text that is used several times acts if it acts once, and is told of once
    const auto is_silent = [](BlendFlaw flaw) {
        return flaw == BlendFlaw::never_acts || flaw == BlendFlaw::unseen;
    };
    std::vector<BlendFinding> out;
    for (std::size_t i = 0; i < blends.size(); ++i) {
        if (!found[i]) return found[i].error();
        bool is_told = false;
        for (std::size_t j = 0; j < blends.size() && !found[i]->empty(); ++j) {
            if (i == j || field.graph->origin(blends[i]) != field.graph->origin(blends[j])) continue;
            if (!found[j]) return found[j].error();
            const bool acts = found[j]->empty() || !is_silent((*found[j])[0].flaw);
            const bool is_same = !found[j]->empty() && (*found[j])[0].flaw == (*found[i])[0].flaw;
            if (is_silent((*found[i])[0].flaw)) is_told = is_told || acts || (j < i && is_same);
            if ((*found[i])[0].flaw == BlendFlaw::coarse) is_told = is_told || (j < i && is_same);
        }
        if (!is_told) out.insert(out.end(), found[i]->begin(), found[i]->end());
    }
    return out;
}

}  // namespace frep
