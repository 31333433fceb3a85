// DepthPainter: layers equal those of all voxels, in both profiles, and of the reference engine; depth and
// normals of known surfaces; sizes, threads, errors.
#include "frep/trace/tile_depth.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "frep/eval/evaluator.h"
#include "frep/eval/isa.h"
#include "unit/trace/tile_models.h"

using namespace frep;
using namespace frep_test;

namespace {

const AxisMap space = AxisMap::standard(3);

template <class Real>
DepthPicture picture(const ClauseTape& tape, const DepthPictureOptions& options, int threads = 1) {
    DepthPainter<Real> painter;
    DepthPicture out;
    Job job;
    job.threads = threads;
    const Status status = painter.paint(tape, space, options, job, out);
    REQUIRE(static_cast<bool>(status));
    return out;
}

DepthPictureOptions sized(int width, int height, int layers) {
    DepthPictureOptions options;
    options.part = {{-1.1, -0.9, -1}, {1, 1.2, 1.05}};
    options.width = width;
    options.height = height;
    options.layers = layers;
    return options;
}

std::size_t reference_differences(const TileModel& model, const DepthPictureOptions& o,
                                  const DepthPicture& got) {
    const auto evaluator = make_evaluator(model.field, {.engine = Engine::reference});
    const Vec3 size = o.part.max - o.part.min;
    std::size_t count = 0;
    for (int j = 0; j < o.height; ++j)
        for (int i = 0; i < o.width; ++i) {
            const double x = o.part.min.x + (i + 0.5) * (size.x / o.width);
            const double y = o.part.max.y + (j + 0.5) * (-size.y / o.height);
            int layer = o.layers;
            for (; layer > 0; --layer) {
                const double z = o.part.min.z + (layer - 0.5) * (size.z / o.layers);
                const double* point[3] = {&x, &y, &z};
                double value = 0;
                double* to = &value;
                (*evaluator)->values(point, 1, {&to, 1});
                if (value >= 0) break;
            }
            count += got.layers[static_cast<std::size_t>(j * o.width + i)] != layer;
        }
    return count;
}

template <class Real>
void check_model(const TileModel& model) {
    CAPTURE(model.name);
    for (const auto& [width, height, layers] :
         {std::array{1, 1, 1}, {7, 3, 5}, {40, 33, 64}, {130, 70, 100}, {64, 64, 257}}) {
        const int side = width;
        CAPTURE(side);
        DepthPictureOptions options = sized(width, height, layers);
        const DepthPicture pruned = picture<Real>(model.tape, options);
        options.prune = false;
        const DepthPicture whole = picture<Real>(model.tape, options);
        CHECK(pruned.layers == whole.layers);
        if (sizeof(Real) == sizeof(double) && width < 60)
            CHECK(reference_differences(model, options, pruned) == 0);
        const double step = (options.part.max.z - options.part.min.z) / layers;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < pruned.layers.size(); ++i) {
            const auto& n = pruned.normals[i];
            const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            if (pruned.layers[i] == 0) {
                wrong += !std::isnan(pruned.z[i]) || length != 0;
            } else {
                const double low = options.part.min.z + (pruned.layers[i] - 0.5) * step;
                wrong += !(pruned.z[i] >= low - 1e-6 && pruned.z[i] <= low + step + 1e-6);
                wrong += !(std::fabs(length - 1) < 1e-5);
            }
        }
        CHECK(wrong == 0);
    }
}

bool same(const DepthPicture& a, const DepthPicture& b) {
    const auto bytes = [](const auto& x, const auto& y) {
        return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0;
    };
    return bytes(a.layers, b.layers) && bytes(a.z, b.z) && bytes(a.normals, b.normals);
}

}  // namespace

TEST_CASE("depth pictures equal those without pruning") {
    for (const TileModel& model : tile_models()) {
        check_model<double>(model);
        check_model<float>(model);
    }
}

TEST_CASE("depth pictures are the same for any number of threads, and after other pictures") {
    DepthPainter<float> painter;
    for (const TileModel& model : tile_models()) {
        const DepthPictureOptions options = sized(150, 90, 120);
        const DepthPicture one = picture<float>(model.tape, options);
        for (const int threads : {2, 3, 8}) {
            DepthPicture again;
            Job job;
            job.threads = threads;
            REQUIRE(static_cast<bool>(painter.paint(model.tape, space, options, job, again)));
            CHECK(same(one, again));
            CHECK(one.point_operations == again.point_operations);
        }
    }
}

TEST_CASE("depth pictures are the same for every instruction set") {
    for (const TileModel& model : tile_models()) {
        CAPTURE(model.name);
        const DepthPictureOptions options = sized(71, 90, 120);  // 71: tiles that the edge cuts
        set_isa_limit(Isa::sse2);
        const DepthPicture floats = picture<float>(model.tape, options);
        const DepthPicture doubles = picture<double>(model.tape, options);
        for (const Isa isa : {Isa::avx2, Isa::avx512}) {
            set_isa_limit(isa);
            CAPTURE(name_of(machine_isa()));
            CHECK(same(floats, picture<float>(model.tape, options)));
            CHECK(same(doubles, picture<double>(model.tape, options)));
        }
    }
}

TEST_CASE("depth and normals of a ball, cut by the box") {
    const auto ball =
        tile_model("ball", [](auto x, auto y, auto z) { return 0.81 - (square(x) + square(y) + square(z)); });
    DepthPictureOptions options;
    options.width = options.height = options.layers = 96;
    options.part = {{-1, -1, -1}, {1, 1, 0.5}};
    const DepthPicture got = picture<double>(ball.tape, options);
    std::size_t curved = 0, flat = 0;
    for (int j = 0; j < 96; ++j)
        for (int i = 0; i < 96; ++i) {
            const auto p = static_cast<std::size_t>(j * 96 + i);
            if (got.layers[p] == 0) continue;
            const double x = -1 + (i + 0.5) / 48, y = 1 - (j + 0.5) / 48;
            const auto& n = got.normals[p];
            if (got.layers[p] == 96) {
                ++flat;
                CHECK(n == std::array<float, 3>{0, 0, 1});
                continue;
            }
            const double z = std::sqrt(0.81 - x * x - y * y);
            if (z < 0.2) continue;  // at the rim the chord is far from the surface
            ++curved;
            CHECK(got.z[p] == doctest::Approx(z).epsilon(1e-3));
            CHECK(n[0] * x + n[1] * y + n[2] * z == doctest::Approx(0.9).epsilon(1e-4));
        }
    CHECK(curved > 1000);
    CHECK(flat > 1000);
}

TEST_CASE("depth pictures: pruning leaves work out") {
    const auto models = tile_models();
    DepthPictureOptions options = sized(128, 128, 128);
    const DepthPicture pruned = picture<float>(models[2].tape, options);
    options.prune = false;
    CHECK(pruned.point_operations * 20 < picture<float>(models[2].tape, options).point_operations);
}

TEST_CASE("depth pictures: errors") {
    const TileModel ball = std::move(tile_models()[0]);
    DepthPainter<double> painter;
    DepthPicture out;
    const auto refused = [&](const DepthPictureOptions& options, const AxisMap& map) {
        const Status status = painter.paint(ball.tape, map, options, {}, out);
        return !status && status.error().kind == ErrorKind::invalid_argument;
    };
    CHECK(refused(sized(0, 5, 5), space));
    CHECK(refused(sized(5, 5, 16385), space));
    CHECK(refused(sized(5, 5, 5), AxisMap::standard(2)));
    DepthPictureOptions flat = sized(5, 5, 5);
    flat.part.max.z = flat.part.min.z;
    CHECK(refused(flat, space));
    Job cancelled;
    cancelled.cancel();
    const Status status = painter.paint(ball.tape, space, sized(64, 64, 64), cancelled, out);
    REQUIRE(!status);
    CHECK(status.error().kind == ErrorKind::cancelled);
}
