#include "frep/base/diagnostic.h"

#include <algorithm>

#include <fmt/format.h>

namespace frep {
namespace {

/// Optimal string alignment distance; stops counting above `limit`.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
    if (a.size() > b.size() + limit || b.size() > a.size() + limit) return limit + 1;
    std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = a[i - 1] == b[j - 1];
            current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (same ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) current[j] = std::min(current[j], before[j - 2] + 1);
        }
        std::swap(before, previous);
        std::swap(previous, current);
    }
    return previous[b.size()];
}

struct Paint {
    bool on;
    std::string operator()(std::string_view code, std::string_view text) const {
        return on ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
    }
};

std::string_view severity_color(Severity severity) {
    return severity == Severity::error ? "1;31" : severity == Severity::warning ? "1;33" : "1;36";
}

/// Code points first..last-1 of a line, each escaped for the terminal; `total` receives the number of all.
std::vector<std::string> cells_of(std::string_view line, std::size_t first, std::size_t last,
                                  std::size_t& total) {
    std::vector<std::string> cells;
    total = 0;
    for (std::size_t i = 0; i < line.size(); ++total) {
        std::size_t next = i + 1;
        while (next < line.size() && (static_cast<unsigned char>(line[next]) & 0xC0) == 0x80) ++next;
        if (total >= first && total < last) cells.push_back(escape_controls(line.substr(i, next - i)));
        i = next;
    }
    return cells;
}

std::size_t printed_width(std::string_view cell) { return cell.starts_with('\\') ? cell.size() : 1; }

/// The source line and the line of carets under [first, last) (0-based code points), clipped to `columns`.
void append_quote(std::string& out, std::string_view line, std::size_t first, std::size_t last,
                  std::string_view label, const std::string& gutter, const std::string& number,
                  std::size_t columns, Paint paint, Severity severity) {
    std::size_t begin = first > columns / 2 ? first - columns / 2 : 0;
    if (line.size() <= columns) begin = 0;
    std::size_t total = 0;
    const std::vector<std::string> cells = cells_of(line, begin, begin + columns, total);
    const std::size_t end = begin + cells.size();
    std::string text = begin > 0 ? "..." : "";
    std::string marks(text.size(), ' ');
    for (std::size_t i = begin; i < end; ++i) {
        text += cells[i - begin];
        marks.append(printed_width(cells[i - begin]), i >= first && i < last ? '^' : ' ');
    }
    if (end < total) text += "...";
    while (!marks.empty() && marks.back() == ' ') marks.pop_back();
    if (marks.empty() || marks.back() != '^') {  // the place is at the end of the line or beyond
        std::size_t width = begin > 0 ? 3 : 0;
        for (std::size_t i = begin; i < std::min(end, first); ++i) width += printed_width(cells[i - begin]);
        marks = std::string(width, ' ') + "^";
    }
    if (!label.empty()) marks += fmt::format(" {}", escape_controls(label));
    out += fmt::format("{}\n", paint("1;34", gutter + " |"));
    out += fmt::format("{} {}\n", paint("1;34", number + " |"), text);
    out += fmt::format("{} {}\n", paint("1;34", gutter + " |"), paint(severity_color(severity), marks));
}

void append_diagnostic(std::string& out, const Diagnostic& d, const Source& source,
                       const RenderOptions& options) {
    const Paint paint{options.color};
    const LineColumn begin = source.locate(d.span.begin);
    const LineColumn end = source.locate(std::max(d.span.end, d.span.begin));
    const std::string number = std::to_string(begin.line);
    const std::string gutter(number.size(), ' ');
    const std::string title = d.code.empty() ? std::string(to_string(d.severity))
                                             : fmt::format("{}[{}]", to_string(d.severity), d.code);
    out += fmt::format("{}: {}\n", paint(severity_color(d.severity), title),
                       paint("1", escape_controls(d.message)));
    out += fmt::format("{}{} {}:{}:{}\n", gutter, paint("1;34", "-->"), escape_controls(source.name()),
                       begin.line, begin.column);
    const std::string_view line = source.line(begin.line);
    const std::size_t first = begin.column - 1;
    const std::size_t last =
        end.line > begin.line ? line.size() : std::max<std::size_t>(end.column - 1, first + 1);
    append_quote(out, line, first, last, d.label, gutter, number, options.columns, paint, d.severity);
    if (!d.help.empty())
        out += fmt::format("{} {}: {}\n", gutter, paint("1;36", "= help"), escape_controls(d.help));
    out += '\n';
}

}  // namespace

bool Diagnostics::has_errors() const { return error_count() > 0; }

std::size_t Diagnostics::error_count() const {
    return static_cast<std::size_t>(std::count_if(
        list_.begin(), list_.end(), [](const auto& d) { return d.severity == Severity::error; }));
}

void Diagnostics::append(const Diagnostics& other) {
    list_.insert(list_.end(), other.list_.begin(), other.list_.end());
}

std::string_view to_string(Severity severity) {
    switch (severity) {
        case Severity::error:
            return "error";
        case Severity::warning:
            return "warning";
        case Severity::note:
            return "note";
    }
    return "note";
}

std::string render(const Diagnostics& diagnostics, const Source& source, const RenderOptions& options) {
    std::string out;
    const auto& list = diagnostics.list();
    const std::size_t shown = std::min(list.size(), options.at_most);
    for (std::size_t i = 0; i < shown; ++i) append_diagnostic(out, list[i], source, options);
    if (shown < list.size()) out += fmt::format("... and {} more\n", list.size() - shown);
    return out;
}

std::string_view nearest_name(std::string_view name, const std::vector<std::string_view>& candidates) {
    if (name.size() > 128) return {};
    const std::string wanted = lower_case(name);
    const std::size_t limit = std::max<std::size_t>(1, name.size() / 3);
    std::string_view best;
    std::size_t best_distance = limit + 1;
    for (std::string_view candidate : candidates) {
        const std::size_t distance = edit_distance(wanted, lower_case(candidate), limit);
        if (distance < best_distance) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

}  // namespace frep
