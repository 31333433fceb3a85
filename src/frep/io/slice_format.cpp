// Implementation of slice_format.h.
#include "frep/io/slice_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "frep/io/encode.h"
#include "frep/io/text.h"

namespace frep {

namespace {

using encode::append_float;
using encode::append_little_endian;
using encode::append_number;
using encode::append_plain_real;

enum Direction : std::uint32_t { clockwise = 0, counter_clockwise = 1, open = 2 };

constexpr std::uint32_t layer_long = 127, polyline_long = 130;  // binary command numbers
constexpr std::uint32_t part_id = 1;

Error invalid(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }

bool fits(double value) {
    constexpr double limit = std::numeric_limits<float>::max();
    return value >= -limit && value <= limit;
}

Status check(const std::vector<Slice>& slices, const SliceOptions& options, double scale) {
    if (!(options.unit.metres > 0 && options.unit.metres <= 1e12)) {
        return invalid("the length of the unit is not positive and finite");
    }
    if (!(options.first_thickness >= 0 && fits(options.first_thickness * scale))) {
        return invalid("the thickness of the first layer is negative or not finite");
    }
    for (std::size_t i = 0; i < slices.size(); ++i) {
        if (!fits(slices[i].z * scale))
            return invalid(fmt::format("the height of slice {} is not finite", i));
        if (i > 0 && !(slices[i].z > slices[i - 1].z)) {
            return invalid(fmt::format("slice {} is not higher than the one before", i));
        }
        for (const Polyline& line : slices[i].outlines) {
            if (line.points.size() > 0x7ffffffeu) {
                return Error{ErrorKind::over_limit, "an outline has more points than the format can count"};
            }
            for (const Vec2& p : line.points) {
                if (fits(p.x * scale) && fits(p.y * scale)) continue;
                return invalid(fmt::format("slice {} has a coordinate that the file format cannot hold", i));
            }
        }
    }
    return {};
}

Direction direction_of(const Polyline& line) {
    if (!line.closed) return open;
    return signed_area(line) < 0 ? clockwise : counter_clockwise;
}

/// Writes layers and polylines in one of the two forms.
class Geometry {
  public:
    Geometry(std::string& out, bool ascii, double scale) : out_(out), ascii_(ascii), scale_(scale) {}

    void layer(double z) {
        if (ascii_) {
            out_ += "$$LAYER/";
            append_plain_real(out_, z * scale_);
            out_.push_back('\n');
        } else {
            append_little_endian(out_, layer_long, 2);
            append_float(out_, z * scale_);
        }
    }

    void polyline(const Polyline& line) {
        const std::size_t count = line.points.size();
        if (count < 2) return;
        head(direction_of(line), static_cast<std::uint32_t>(count + (line.closed ? 1 : 0)));
        for (const Vec2& p : line.points) point(p);
        if (line.closed) point(line.points[0]);
        if (ascii_) out_.push_back('\n');
    }

  private:
    void head(Direction direction, std::uint32_t points) {
        if (!ascii_) append_little_endian(out_, polyline_long, 2);
        if (ascii_) out_ += "$$POLYLINE/";
        integer(part_id, true);
        integer(direction, false);
        integer(points, false);
    }

    void integer(std::uint32_t value, bool first) {
        if (ascii_) {
            if (!first) out_.push_back(',');
            append_number(out_, value);
        } else {
            append_little_endian(out_, value);
        }
    }

    void point(const Vec2& p) {
        for (const double c : {p.x * scale_, p.y * scale_}) {
            if (ascii_) {
                out_.push_back(',');
                append_plain_real(out_, c);
            } else {
                append_float(out_, c);
            }
        }
    }

    std::string& out_;
    bool ascii_;
    double scale_;
};

/// `$$DIMENSION/`: the box around all outlines; nothing when there is none.
void append_dimension(std::string& out, const std::vector<Slice>& slices, double scale) {
    Box3 box;
    bool empty = true;
    for (const Slice& slice : slices) {
        for (const Polyline& line : slice.outlines) {
            for (const Vec2& p : line.points) {
                const Vec3 q{p.x, p.y, slice.z};
                if (empty) box = {q, q};
                empty = false;
                box.min = {std::min(box.min.x, q.x), std::min(box.min.y, q.y), std::min(box.min.z, q.z)};
                box.max = {std::max(box.max.x, q.x), std::max(box.max.y, q.y), std::max(box.max.z, q.z)};
            }
        }
    }
    if (empty) return;
    out += "$$DIMENSION/";
    for (const double c : {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z}) {
        append_plain_real(out, c * scale);
        out.push_back(',');
    }
    out.back() = '\n';
}

std::string header(const std::vector<Slice>& slices, const SliceOptions& options, double scale) {
    std::string out = options.ascii ? "$$HEADERSTART\n$$ASCII\n" : "$$HEADERSTART\n$$BINARY\n";
    out += "$$UNITS/1\n$$VERSION/200\n";
    if (!options.label.empty()) {
        out += fmt::format("$$LABEL/{},{}\n", part_id, encode::identifier(options.label, "part_"));
    }
    append_dimension(out, slices, scale);
    out += fmt::format("$$LAYERS/{}\n$$HEADEREND", slices.size() + (options.first_thickness > 0 ? 1 : 0));
    return out;  // binary geometry follows at once
}

}  // namespace

Result<std::string> encode_slices(const std::vector<Slice>& slices, const SliceOptions& options) {
    const double scale = options.unit.metres == 0.001 ? 1 : options.unit.metres * 1000;
    if (Status ok = check(slices, options, scale); !ok) return ok.error();
    const bool with_base = options.first_thickness > 0 && !slices.empty();
    SliceOptions told = options;
    if (!with_base) told.first_thickness = 0;
    std::string out = header(slices, told, scale);
    if (options.ascii) out += "\n$$GEOMETRYSTART\n";
    Geometry geometry(out, options.ascii, scale);
    if (with_base) geometry.layer(slices[0].z - options.first_thickness);
    for (const Slice& slice : slices) {
        geometry.layer(slice.z);
        for (const Polyline& line : slice.outlines) geometry.polyline(line);
    }
    if (options.ascii) out += "$$GEOMETRYEND\n";
    return out;
}

}  // namespace frep
