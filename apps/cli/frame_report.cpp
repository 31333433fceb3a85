// Implementation of frame_report.h.
#include "frame_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "terminal.h"
#include "values.h"

namespace frep::cli {

namespace {

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::string list_of(const std::vector<FrameMeasure>& frames, const std::vector<std::size_t>& which,
                    const std::string& name) {
    constexpr std::size_t most = 5;
    std::string out;
    for (std::size_t i = 0; i < std::min(most, which.size()); ++i)
        out +=
            fmt::format("{}{} ({} = {:.4g})", i == 0 ? "" : ", ", which[i] + 1, name, frames[which[i]].value);
    if (which.size() > most) out += fmt::format(" and {} more", which.size() - most);
    return out;
}

}  // namespace

Result<std::vector<FrameMeasure>> measure_frames(MovingModel& model, const std::vector<double>& values,
                                                 const Box3& box, double iso, int cells, const Job& job) {
    std::vector<FrameMeasure> out;
    Occupancy before;
    for (const double value : values) {
        if (const Status status = model.set(value); !status) return status.error();
        const auto field = model.field(iso, false);
        if (!field) return field.error();
        FieldPool pool(**field);
        auto now = sample_occupancy(pool, box, cells, job);
        if (!now) return now.error();
        out.push_back({value, now->size(), now->components(), out.empty() ? 0 : difference(before, *now)});
        before = std::move(*now);
        job.report(static_cast<double>(out.size()) / static_cast<double>(values.size()));
    }
    return out;
}

std::vector<double> even_values(const std::vector<FrameMeasure>& fine, int count) {
    double total = 0;
    for (const FrameMeasure& m : fine) total += m.change;
    // a little of the plain parameter keeps the inverse unique where the shape rests
    const double rest = total > 0 ? 1e-3 * total / static_cast<double>(fine.size()) : 1;
    std::vector<double> sums{0};
    for (std::size_t i = 1; i < fine.size(); ++i) sums.push_back(sums.back() + fine[i].change + rest);
    std::vector<double> out;
    std::size_t k = 0;
    for (int i = 0; i < count; ++i) {
        const double wanted = sums.back() * i / (count - 1);
        while (k + 2 < sums.size() && sums[k + 1] < wanted) ++k;
        const double share = std::clamp((wanted - sums[k]) / (sums[k + 1] - sums[k]), 0.0, 1.0);
        out.push_back(fine[k].value + share * (fine[k + 1].value - fine[k].value));
    }
    out.back() = fine.back().value;
    return out;
}

void warn_about_frames(const std::vector<FrameMeasure>& frames, const std::string& name) {
    std::vector<std::size_t> empty, jumps;
    std::vector<double> changes;
    double size = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (frames[i].size == 0) empty.push_back(i);
        if (i > 0) changes.push_back(frames[i].change);
        size += frames[i].size / static_cast<double>(frames.size());
    }
    const double usual = median(changes);
    for (std::size_t i = 1; i < frames.size(); ++i)
        if (frames[i].change > 0.5 * size && frames[i].change > 4 * usual) jumps.push_back(i);
    if (!empty.empty()) print_warning("empty frames: " + list_of(frames, empty, name));
    if (!jumps.empty())
        print_warning("the shape jumps at the frames " + list_of(frames, jumps, name) +
                      "; more frames, or --even, make it slower");
}

Json frame_report(const std::vector<FrameMeasure>& frames, const std::string& name, bool flat) {
    Json out;
    out["schema"] = "frep.animate/1";
    out["along"] = json_text(name);
    out["measure"] = flat ? "area" : "volume";
    Json list = Json::array();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const FrameMeasure& m = frames[i];
        Json row;
        row["frame"] = i + 1;
        row["value"] = json_number(m.value);
        row[flat ? "area" : "volume"] = json_number(m.size);
        row["components"] = m.components;
        row["change"] = json_number(m.change);
        const double step = i == 0 ? 0 : std::abs(m.value - frames[i - 1].value);
        row["rate_of_change"] = step > 0 ? json_number(m.change / step) : Json(nullptr);
        list.push_back(std::move(row));
    }
    out["frames"] = std::move(list);
    return out;
}

}  // namespace frep::cli
