// SignPainter: pictures equal those that evaluate the whole tape at every pixel, in both profiles, and the
// reference engine; sizes, threads, maps, undefined pixels, errors.
#include "frep/trace/tile_sign.h"

#include <doctest/doctest.h>

#include "frep/eval/evaluator.h"
#include "unit/trace/tile_models.h"

using namespace frep;
using namespace frep_test;

namespace {

const AxisMap space = AxisMap::standard(3);

template <class Real>
SignPicture picture(const ClauseTape& tape, const SignPictureOptions& options, int threads = 1,
                    const AxisMap& map = space) {
    SignPainter<Real> painter;
    SignPicture out;
    Job job;
    job.threads = threads;
    const Status status = painter.paint(tape, map, options, job, out);
    REQUIRE(static_cast<bool>(status));
    return out;
}

SignPictureOptions sized(int width, int height) {
    SignPictureOptions options;
    options.plane.at = 0.1;
    options.part = {{-1.1, -0.9}, {1, 1.2}};
    options.width = width;
    options.height = height;
    return options;
}

std::size_t differences(const SignPicture& a, const SignPicture& b) {
    REQUIRE(a.pixels.size() == b.pixels.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i];
    return count;
}

/// The picture by the reference engine, a point at a time.
std::size_t reference_differences(const TileModel& model, const SignPictureOptions& o,
                                  const SignPicture& got) {
    const auto evaluator = make_evaluator(model.field, {.engine = Engine::reference});
    std::size_t count = 0;
    for (int j = 0; j < o.height; ++j)
        for (int i = 0; i < o.width; ++i) {
            const double x = o.part.min.x + (i + 0.5) * (o.part.width() / o.width);
            const double y = o.part.max.y + (j + 0.5) * (-o.part.height() / o.height);
            const double* point[3] = {&x, &y, &o.plane.at};
            double value = 0;
            double* to = &value;
            (*evaluator)->values(point, 1, {&to, 1});
            const SignPixel expected = value >= 0                            ? SignPixel::inside
                                       : value == value || !o.tell_undefined ? SignPixel::outside
                                                                             : SignPixel::undefined;
            count += got.pixels[static_cast<std::size_t>(j * o.width + i)] != expected;
        }
    return count;
}

template <class Real>
void check_model(const TileModel& model) {
    CAPTURE(model.name);
    for (const auto& [width, height] :
         {std::pair(1, 1), {5, 3}, {64, 64}, {100, 37}, {130, 257}, {300, 300}}) {
        for (const bool tell : {false, true}) {
            CAPTURE(width);
            CAPTURE(tell);
            SignPictureOptions options = sized(width, height);
            options.tell_undefined = tell;
            const SignPicture pruned = picture<Real>(model.tape, options);
            options.prune = false;
            CHECK(differences(pruned, picture<Real>(model.tape, options)) == 0);
            if (sizeof(Real) == sizeof(double) && width < 200)
                CHECK(reference_differences(model, options, pruned) == 0);
        }
    }
}

}  // namespace

TEST_CASE("sign pictures equal those without pruning") {
    for (const TileModel& model : tile_models()) {
        check_model<double>(model);
        check_model<float>(model);
    }
}

TEST_CASE("sign pictures: pruning leaves work out") {
    const auto models = tile_models();
    SignPictureOptions options = sized(512, 512);
    const SignPicture pruned = picture<float>(models[2].tape, options);
    options.prune = false;
    const SignPicture whole = picture<float>(models[2].tape, options);
    CHECK(whole.point_operations == 512u * 512u * models[2].tape.clauses.size());
    CHECK(pruned.point_operations * 20 < whole.point_operations);
    CHECK(pruned.tile_operations > 0);
}

TEST_CASE("sign pictures are the same for any number of threads, and after other pictures") {
    const auto models = tile_models();
    SignPainter<float> painter;
    for (const int width : {30, 200, 333}) {
        const SignPictureOptions options = sized(width, 200);
        for (const TileModel& model : models) {
            const SignPicture one = picture<float>(model.tape, options);
            for (const int threads : {2, 3, 8}) {
                SignPicture again;
                Job job;
                job.threads = threads;
                REQUIRE(static_cast<bool>(painter.paint(model.tape, space, options, job, again)));
                CHECK(differences(one, again) == 0);
                CHECK(one.point_operations == again.point_operations);
                CHECK(one.tile_operations == again.tile_operations);
            }
        }
    }
}

TEST_CASE("sign pictures of other planes and maps") {
    const TileModel slab =
        tile_model("slab", [](auto x, auto y, auto z) { return min(min(x + 0.0 * y, 0.5 - x), z - 0.25); });
    SignPictureOptions options = sized(64, 64);
    options.part = {{-1, -1}, {1, 1}};
    options.plane = Plane::across(1, 0);  // to the right x, up z
    const SignPicture side = picture<double>(slab.tape, options);
    const auto at = [&](const SignPicture& p, double u, double v) {
        const auto i = static_cast<std::size_t>((u + 1) * 32), j = static_cast<std::size_t>((1 - v) * 32);
        return p.pixels[j * 64 + i];
    };
    CHECK(at(side, 0.3, 0.6) == SignPixel::inside);
    CHECK(at(side, 0.3, 0.1) == SignPixel::outside);
    CHECK(at(side, -0.3, 0.6) == SignPixel::outside);
    // x of the model is z of space, and z of the model is frozen
    const AxisMap map{{{2, 0}, {1, 0}, {-1, 0.3}}};
    const SignPicture turned = picture<double>(slab.tape, options, 1, map);
    CHECK(at(turned, 0.9, 0.3) == SignPixel::inside);
    CHECK(at(turned, 0.3, 0.6) == SignPixel::outside);
}

TEST_CASE("sign pictures: errors") {
    const TileModel ball = std::move(tile_models()[0]);
    SignPainter<double> painter;
    SignPicture out;
    const auto refused = [&](const SignPictureOptions& options, const AxisMap& map) {
        const Status status = painter.paint(ball.tape, map, options, {}, out);
        return !status && status.error().kind == ErrorKind::invalid_argument;
    };
    CHECK(refused(sized(0, 5), space));
    CHECK(refused(sized(5, 16385), space));
    CHECK(refused(sized(5, 5), AxisMap::standard(2)));
    SignPictureOptions flat = sized(5, 5);
    flat.part.max.x = flat.part.min.x;
    CHECK(refused(flat, space));
    Job cancelled;
    cancelled.cancel();
    const Status status = painter.paint(ball.tape, space, sized(64, 64), cancelled, out);
    REQUIRE(!status);
    CHECK(status.error().kind == ErrorKind::cancelled);
}
