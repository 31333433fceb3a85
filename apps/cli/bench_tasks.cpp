// Implementation of bench_tasks.h.
#include "bench_tasks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace frep::cli {

namespace {

/// The tape that the tasks run, or why there is none.
Result<ClauseTape> tape_of(const PreparedModel& prepared) {
    auto tape = make_clause_tape(bind_parameters(prepared.field()));
    if (!tape)
        return Error{ErrorKind::invalid_argument,
                     "the model has loops that depend on the point: only the tasks load and mesh run it"};
    return std::move(*tape);
}

std::string_view profile_name(const BenchOptions& options) {
    return options.binary32 ? "binary32" : "binary64";
}

/// Text in memory to a tape that is ready to be evaluated.
Result<TaskOutcome> run_load(const PreparedModel& prepared, const BenchOptions& options) {
    const Source& source = prepared.model.source();
    const std::string text(source.text());
    const std::string folder = std::filesystem::path(source.name()).parent_path().string();
    TaskOutcome out{.task = "load", .profile = "binary64", .size = static_cast<int>(source.line_count())};
    out.amount = source.line_count();
    out.unit = "lines";
    const auto time = measure(options.repeat, [&]() -> Status {
        const Model model(Source(source.name(), text), files_of_folder(folder), prepared.model.text_form());
        Diagnostics found;
        const auto lowered = model.lower(prepared.object, prepared.field().parameters, found);
        if (!lowered) return Error{ErrorKind::invalid_model, "the model cannot be loaded again"};
        const Field bound = bind_parameters(lowered->field);
        const auto tape = make_clause_tape(bound);
        if (tape) out.point_operations = static_cast<double>(tape->clauses.size());
        return {};
    });
    if (!time) return time.error();
    out.time = *time;
    return out;
}

/// Points on a lattice of irrational steps in the box; columns for all coordinates of the model.
template <class Real>
class PointColumns {
  public:
    PointColumns(const PreparedModel& prepared, const Box3& box, std::size_t count) {
        const std::array<double, 3> low{box.min.x, box.min.y, box.min.z};
        const std::array<double, 3> high{box.max.x, box.max.y, box.max.z};
        // the plastic number's powers fill space evenly (Roberts 2018)
        constexpr std::array<double, 3> step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
        for (const MappedCoordinate& c : prepared.map.coordinates) {
            std::vector<Real> column(count, static_cast<Real>(c.value));
            if (const auto a = static_cast<std::size_t>(c.axis); c.axis >= 0)
                for (std::size_t i = 0; i < count; ++i) {
                    const double turn = static_cast<double>(i + 1) * step[a];
                    column[i] = static_cast<Real>(low[a] + (turn - std::floor(turn)) * (high[a] - low[a]));
                }
            columns_.push_back(std::move(column));
        }
        for (const auto& column : columns_) pointers_.push_back(column.data());
    }
    std::span<const Real* const> pointers() const { return pointers_; }

  private:
    std::vector<std::vector<Real>> columns_;
    std::vector<const Real*> pointers_;
};

constexpr int dense_points = 4096;
/// Clauses on points that a run does at least, so that it can be timed.
constexpr double least_operations = 4e7;

/// How the points of a task are evaluated.
enum class PointWork { values, gradients, native };

/// Where the points of `box` lie in each coordinate of the model.
std::vector<math::Interval> domain_of(const PreparedModel& prepared, const Box3& box) {
    std::vector<math::Interval> domain;
    for (const MappedCoordinate& c : prepared.map.coordinates) {
        const math::Interval sides[3] = {
            {box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}};
        domain.push_back(c.axis < 0 ? math::Interval(c.value) : sides[c.axis]);
    }
    return domain;
}

template <class Real>
Result<TaskOutcome> run_points(const PreparedModel& prepared, const BenchOptions& options, PointWork work) {
    auto tape = tape_of(prepared);
    if (!tape) return tape.error();
    pack_rows(*tape);
    const auto count = static_cast<std::size_t>(options.size.value_or(dense_points));
    const PointColumns<Real> points(prepared, options.box, count);
    const std::size_t clauses = std::max<std::size_t>(tape->clauses.size(), 1);
    const double once = static_cast<double>(clauses) * static_cast<double>(count);
    const auto turns = static_cast<int>(std::ceil(least_operations / once));
    std::vector<Real> values(count);
    std::vector<std::vector<Real>> partials(prepared.map.coordinates.size(), std::vector<Real>(count));
    std::vector<Real*> partial_pointers;
    for (auto& column : partials) partial_pointers.push_back(column.data());
    BatchVm<Real> vm;
    const std::vector<math::Interval> domain = domain_of(prepared, options.box);
    std::optional<NativeCode<Real>> code;
    if (work == PointWork::native) {
        code = NativeCode<Real>::compile(*tape, {.isa = machine_isa(), .domain = domain});
        if (!code) return Error{ErrorKind::over_limit, "the system gives no memory for machine code"};
    }
    TaskOutcome out{.profile = profile_name(options)};
    out.size = static_cast<int>(count);
    out.amount = static_cast<double>(count) * turns;
    out.unit = "points";
    out.point_operations = static_cast<double>(tape->clauses.size()) * out.amount;
    const auto time = measure(options.repeat, [&]() -> Status {
        for (int i = 0; i < turns; ++i) {
            if (work == PointWork::gradients)
                vm.gradients(*tape, points.pointers(), count, values.data(), partial_pointers);
            else if (work == PointWork::native)
                code->run(points.pointers().data(), count, values.data());
            else
                vm.values(*tape, points.pointers(), count, values.data());
        }
        return {};
    });
    if (!time) return time.error();
    out.time = *time;
    return out;
}

Result<TaskOutcome> run_points(const PreparedModel& prepared, const BenchOptions& options, PointWork work,
                               std::string_view name) {
    auto out = options.binary32 ? run_points<float>(prepared, options, work)
                                : run_points<double>(prepared, options, work);
    if (out) out->task = name;
    return out;
}

Result<TaskOutcome> run_dense(const PreparedModel& prepared, const BenchOptions& options) {
    return run_points(prepared, options, PointWork::values, "dense");
}
Result<TaskOutcome> run_gradient(const PreparedModel& prepared, const BenchOptions& options) {
    return run_points(prepared, options, PointWork::gradients, "gradient");
}
Result<TaskOutcome> run_native(const PreparedModel& prepared, const BenchOptions& options) {
    return run_points(prepared, options, PointWork::native, "native");
}

/// The tape of F as machine code; what a run of `native` leaves out.
Result<TaskOutcome> run_compile(const PreparedModel& prepared, const BenchOptions& options) {
    auto tape = tape_of(prepared);
    if (!tape) return tape.error();
    pack_rows(*tape);
    const std::vector<math::Interval> domain = domain_of(prepared, options.box);
    TaskOutcome out{.task = "compile", .profile = profile_name(options)};
    out.amount = static_cast<double>(tape->clauses.size());
    out.unit = "clauses";
    const auto time = measure(options.repeat, [&]() -> Status {
        const NativeOptions wanted{.isa = machine_isa(), .domain = domain};
        const bool made = options.binary32 ? NativeCode<float>::compile(*tape, wanted).has_value()
                                           : NativeCode<double>::compile(*tape, wanted).has_value();
        if (!made) return Error{ErrorKind::over_limit, "the system gives no memory for machine code"};
        return {};
    });
    if (!time) return time.error();
    out.time = *time;
    return out;
}

/// Ranges over 16 equal parts of a part of the box.
Result<TaskOutcome> run_interval(const PreparedModel& prepared, const BenchOptions& options) {
    const auto tape = tape_of(prepared);
    if (!tape) return tape.error();
    // in a box of -1..1 it is [-.1, .15] x [.1, .3] x [.2, .4]
    constexpr std::array<double, 3> from{0.45, 0.55, 0.6}, to{0.575, 0.65, 0.7};
    const Vec3 low = options.box.min, size = options.box.max - options.box.min;
    const std::array<double, 3> corner{low.x, low.y, low.z}, extent{size.x, size.y, size.z};
    BoxLanes boxes;
    boxes.count = tile_lanes;
    for (std::size_t i = 0; i < prepared.map.coordinates.size(); ++i)
        for (std::size_t k = 0; k < tile_lanes; ++k) {
            const MappedCoordinate& c = prepared.map.coordinates[i];
            boxes.lo[i][k] = boxes.hi[i][k] = c.value;
            if (c.axis < 0) continue;
            const auto a = static_cast<std::size_t>(c.axis);
            const std::size_t parts = a == 0 ? 16 : 1, part = a == 0 ? k : 0;
            const double step = (to[a] - from[a]) / static_cast<double>(parts);
            boxes.lo[i][k] = corner[a] + extent[a] * (from[a] + step * static_cast<double>(part));
            boxes.hi[i][k] = corner[a] + extent[a] * (from[a] + step * static_cast<double>(part + 1));
        }
    const double once = static_cast<double>(std::max<std::size_t>(tape->clauses.size(), 1)) * tile_lanes;
    const auto turns = static_cast<int>(std::ceil(least_operations / once));
    Pruner pruner;
    RangeLanes ranges;
    TaskOutcome out{.task = "interval", .profile = "binary32", .size = tile_lanes};
    out.amount = static_cast<double>(turns) * tile_lanes;
    out.unit = "boxes";
    out.tile_operations = static_cast<double>(tape->clauses.size()) * out.amount;
    const auto time = measure(options.repeat, [&]() -> Status {
        for (int i = 0; i < turns; ++i) pruner.ranges(*tape, boxes, ranges);
        return {};
    });
    if (!time) return time.error();
    out.time = *time;
    return out;
}

constexpr int picture_side = 1024;

template <class Real>
Result<TaskOutcome> paint_signs(const PreparedModel& prepared, const BenchOptions& options) {
    const auto tape = tape_of(prepared);
    if (!tape) return tape.error();
    SignPictureOptions wanted;
    wanted.plane = Plane::across(unused_axis(prepared).value_or(2), 0);
    wanted.part = {wanted.plane.flat(options.box.min), wanted.plane.flat(options.box.max)};
    wanted.width = wanted.height = options.size.value_or(picture_side);
    SignPainter<Real> painter;
    SignPicture picture;
    Job job;
    job.threads = options.threads;
    const auto time =
        measure(options.repeat, [&] { return painter.paint(*tape, prepared.map, wanted, job, picture); });
    if (!time) return time.error();
    TaskOutcome out{.task = "picture", .profile = profile_name(options), .size = wanted.width};
    out.amount = static_cast<double>(picture.pixels.size());
    out.unit = "pixels";
    out.tile_operations = static_cast<double>(picture.tile_operations);
    out.point_operations = static_cast<double>(picture.point_operations);
    out.time = *time;
    out.picture = Image::sized(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const std::uint8_t shade = picture.pixels[i] == SignPixel::inside ? 255 : 0;
        std::fill_n(out.picture.pixels.begin() + static_cast<std::ptrdiff_t>(4 * i), 3, shade);
        out.picture.pixels[4 * i + 3] = 255;
    }
    return out;
}

Result<TaskOutcome> run_picture(const PreparedModel& prepared, const BenchOptions& options) {
    return options.binary32 ? paint_signs<float>(prepared, options) : paint_signs<double>(prepared, options);
}

template <class Real>
Result<TaskOutcome> paint_depth(const PreparedModel& prepared, const BenchOptions& options) {
    const auto tape = tape_of(prepared);
    if (!tape) return tape.error();
    DepthPictureOptions wanted;
    wanted.part = options.box;
    wanted.width = wanted.height = wanted.layers = options.size.value_or(picture_side);
    DepthPainter<Real> painter;
    DepthPicture picture;
    Job job;
    job.threads = options.threads;
    const auto time =
        measure(options.repeat, [&] { return painter.paint(*tape, prepared.map, wanted, job, picture); });
    if (!time) return time.error();
    TaskOutcome out{.task = "depth", .profile = profile_name(options), .size = wanted.width};
    out.amount = static_cast<double>(picture.layers.size());
    out.unit = "pixels";
    out.tile_operations = static_cast<double>(picture.tile_operations);
    out.point_operations = static_cast<double>(picture.point_operations);
    out.time = *time;
    out.picture = Image::sized(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.layers.size(); ++i) {
        const bool hit = picture.layers[i] != 0;
        for (std::size_t a = 0; a < 3; ++a)
            out.picture.pixels[4 * i + a] =
                hit ? static_cast<std::uint8_t>(127.5F + 127.0F * picture.normals[i][a]) : 0;
        out.picture.pixels[4 * i + 3] = 255;
    }
    return out;
}

Result<TaskOutcome> run_depth(const PreparedModel& prepared, const BenchOptions& options) {
    return options.binary32 ? paint_depth<float>(prepared, options) : paint_depth<double>(prepared, options);
}

Result<TaskOutcome> run_mesh_task(const PreparedModel& prepared, const BenchOptions& options) {
    const auto field = sampled_field(prepared);
    if (!field) return field.error();
    ContourOptions wanted;
    wanted.bounds = options.box;
    wanted.cells = options.size.value_or(128);
    wanted.method = options.method;
    Job job;
    job.threads = options.threads;
    std::size_t triangles = 0;
    const auto time = measure(options.repeat, [&]() -> Status {
        const auto result = contour_solid(**field, wanted, job);
        if (!result) return result.error();
        triangles = result->mesh.triangles.size();
        return {};
    });
    if (!time) return time.error();
    TaskOutcome out{.task = "mesh", .profile = "binary64", .size = wanted.cells};
    out.amount = static_cast<double>(triangles);
    out.unit = "triangles";
    out.time = *time;
    return out;
}

constexpr std::array tasks{
    BenchTask{"load", "text in memory to a tape that can be evaluated", run_load},
    BenchTask{"dense", "F at points (--size of them a batch)", run_dense},
    BenchTask{"gradient", "F and its partial derivatives at points", run_gradient},
    BenchTask{"compile", "the tape as machine code", run_compile, true},
    BenchTask{"native", "F at the same points by machine code", run_native, true},
    BenchTask{"interval", "ranges of F over 16 boxes at a time", run_interval},
    BenchTask{"picture", "where F is inside on a plane, --size pixels a side", run_picture},
    BenchTask{"depth", "depth and normals from +z, --size voxels a side", run_depth},
    BenchTask{"mesh", "the surface as triangles, --size cells a side", run_mesh_task},
};

}  // namespace

std::span<const BenchTask> bench_tasks() { return tasks; }

}  // namespace frep::cli
