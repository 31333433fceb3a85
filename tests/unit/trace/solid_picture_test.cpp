// Pictures of solids: properties that hold for every light: same bytes for every number of threads, framing,
// the colors of faces, transparency, turntables, refused sizes.
#include "frep/trace/solid_picture.h"

#include <doctest/doctest.h>

#include <memory>

#include "frep/field/expression.h"

using namespace frep;

namespace {

template <class Body>
std::unique_ptr<SampledField> solid(Body body, Engine engine = Engine::vm) {
    auto graph = std::make_shared<Graph>();
    const Expression x(*graph, graph->coordinate(0)), y(*graph, graph->coordinate(1)),
        z(*graph, graph->coordinate(2));
    Field field;
    field.value = body(x, y, z).id();
    field.graph = graph;
    field.coordinates = 3;
    auto evaluator = make_evaluator(field, {.engine = engine});
    REQUIRE(evaluator);
    auto sampled = make_sampled_field(std::move(*evaluator), AxisMap::standard(3));
    REQUIRE(sampled);
    return std::move(*sampled);
}

const auto ball = [](auto x, auto y, auto z) { return 1.0 - sqrt(x * x + y * y + z * z); };
const auto bar = [](auto x, auto y, auto z) { return 1.0 - max(abs(x), max(abs(y) * 4.0, abs(z) * 2.0)); };

SceneOptions scene_of(double half) {
    SceneOptions scene;
    scene.bounds = Box3::cube(half);
    scene.quality = PictureQuality::draft;
    scene.longest_side = 80;
    return scene;
}

PictureOptions small() {
    PictureOptions options;
    options.width = 80;
    options.height = 60;
    return options;
}

Image picture(const SampledField& field, const SceneOptions& scene, const PictureOptions& options,
              int threads = 0) {
    Job job;
    job.threads = threads;
    auto image = render_solid(field, scene, options, job);
    REQUIRE(image);
    return std::move(*image);
}

const std::uint8_t* pixel(const Image& image, int x, int y) {
    return &image.pixels[static_cast<std::size_t>(4 * (y * image.width + x))];
}

/// First and last column and row with an opaque pixel.
struct Extent {
    int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};
Extent extent(const Image& image) {
    Extent e;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (pixel(image, x, y)[3] > 127) {
                e.left = std::min(e.left, x), e.right = std::max(e.right, x);
                e.top = std::min(e.top, y), e.bottom = std::max(e.bottom, y);
            }
    return e;
}

PictureOptions cut_out() {
    PictureOptions options = small();
    options.backdrop = Backdrop::transparent;
    options.ground = false;
    return options;
}

}  // namespace

TEST_CASE("the same bytes for every number of threads and every engine") {
    PictureOptions options = small();
    options.material = find_material("lacquer");
    const auto one = picture(*solid(ball), scene_of(1.5), options, 1);
    CHECK(one.pixels == picture(*solid(ball), scene_of(1.5), options, 2).pixels);
    CHECK(one.pixels == picture(*solid(ball), scene_of(1.5), options, 8).pixels);
    CHECK(one.pixels == picture(*solid(ball, Engine::reference), scene_of(1.5), options, 2).pixels);
}

TEST_CASE("the object fills the picture, however loose the box is") {
    for (const double half : {1.2, 4.0}) {
        const Extent e = extent(picture(*solid(ball), scene_of(half), cut_out()));
        CHECK(e.bottom - e.top + 1 >= 44);
        CHECK(e.top >= 2);
        CHECK(e.bottom <= 57);
        CHECK(std::abs((e.left + e.right) - 79) <= 2);
        CHECK(std::abs((e.top + e.bottom) - 59) <= 2);
    }
}

TEST_CASE("named directions show the sides that they name") {
    PictureOptions options = cut_out();
    options.view = {.azimuth = 0, .elevation = 0, .field_of_view = 0};
    Extent e = extent(picture(*solid(bar), scene_of(1.5), options));
    CHECK(double(e.right - e.left + 1) / (e.bottom - e.top + 1) == doctest::Approx(2).epsilon(0.06));
    options.view.azimuth = 90;
    e = extent(picture(*solid(bar), scene_of(1.5), options));
    CHECK(double(e.right - e.left + 1) / (e.bottom - e.top + 1) == doctest::Approx(0.5).epsilon(0.06));
    options.view = {.azimuth = 0, .elevation = 90, .field_of_view = 0};
    e = extent(picture(*solid(bar), scene_of(1.5), options));
    CHECK(double(e.right - e.left + 1) / (e.bottom - e.top + 1) == doctest::Approx(4).epsilon(0.08));
}

TEST_CASE("transparent pictures: opaque object, shadow of the table only with a table") {
    PictureOptions options = cut_out();
    const Image bare = picture(*solid(ball), scene_of(1.5), options);
    CHECK(pixel(bare, 40, 30)[3] == 255);
    CHECK(pixel(bare, 0, 0)[3] == 0);
    CHECK(pixel(bare, 79, 59)[3] == 0);
    options.ground = true;
    const Image standing = picture(*solid(ball), scene_of(1.5), options);
    int shaded = 0;
    for (int x = 0; x < 80; ++x) {
        const std::uint8_t* p = pixel(standing, x, 56);
        if (p[3] > 20) {
            ++shaded;
            CHECK(int{p[0]} + p[1] + p[2] < 200);
        }
    }
    CHECK(shaded > 5);
    CHECK(pixel(standing, 40, 0)[3] == 0);
}

TEST_CASE("a section shows its face in another color, towards the viewer") {
    SceneOptions scene = scene_of(1.5);
    PictureOptions options = cut_out();
    options.view = {.azimuth = 0, .elevation = 0, .field_of_view = 0};
    options.color = Color{0.1, 0.1, 0.9};
    options.section_color = Color{0.9, 0.8, 0.1};
    const std::uint8_t* blue = nullptr;
    const Image whole = picture(*solid(ball), scene, options);
    blue = pixel(whole, 40, 30);
    CHECK(blue[2] > blue[0] + 40);
    scene.section = section_towards(options.view, 1, 0.25);
    CHECK(!scene.section->keeps_less);
    const Image cut = picture(*solid(ball), scene, options);
    const std::uint8_t* yellow = pixel(cut, 40, 30);
    CHECK(yellow[0] > yellow[2] + 40);
    scene.section->value = 7;
    CHECK(!render_solid(*solid(ball), scene, options, Job()));
}

TEST_CASE("one scene, many pictures: a turn of a round thing changes nothing of its outline") {
    const auto field = solid([](auto x, auto y, auto z) { return 1.0 - sqrt(x * x + y * y + 4.0 * z * z); });
    const auto scene = SolidScene::make(*field, scene_of(1.5), Job());
    REQUIRE(scene);
    PictureOptions options = cut_out();
    options.framed_all_round = true;
    const auto first = scene->picture(options, Job());
    options.view.azimuth += 90;
    const auto quarter = scene->picture(options, Job());
    options.view.azimuth += 270;
    const auto full = scene->picture(options, Job());
    REQUIRE((first && quarter && full));
    CHECK(first->pixels == full->pixels);
    const Extent a = extent(*first), b = extent(*quarter);
    CHECK(std::abs(a.left - b.left) <= 1);
    CHECK(std::abs(a.top - b.top) <= 1);
}

TEST_CASE("every material gives a picture of its own color") {
    PictureOptions options = cut_out();
    std::vector<std::vector<std::uint8_t>> seen;
    for (const NamedMaterial& material : materials()) {
        options.material = &material;
        const Image image = picture(*solid(ball), scene_of(1.5), options);
        CHECK(pixel(image, 40, 30)[3] == 255);
        for (const auto& other : seen) CHECK(image.pixels != other);
        seen.push_back(image.pixels);
    }
    CHECK(find_material("LACQUER") == find_material("lacquer"));
    CHECK(find_material("jade") == nullptr);
}

TEST_CASE("nothing to see, and sizes that are refused") {
    const auto none = solid([](auto x, auto, auto) { return -1.0 - x * x; });
    const auto scene = SolidScene::make(*none, scene_of(1), Job());
    REQUIRE(scene);
    CHECK(!scene->has_solid());
    PictureOptions options = small();
    CHECK(scene->picture(options, Job()));
    options.width = 0;
    CHECK(!scene->picture(options, Job()));
    options = small();
    options.view.elevation = 91;
    CHECK(!scene->picture(options, Job()));
    SceneOptions flat = scene_of(1);
    flat.bounds.max.z = -1;
    CHECK(!SolidScene::make(*none, flat, Job()));
}

TEST_CASE("only drafts of fields with dear ranges are sampled") {
    const auto field = solid([](auto x, auto y, auto z) {
        Expression sum = 1.0 - sqrt(x * x + y * y + z * z);
        for (int n = 0; n < 6; ++n) sum = sum + 0.01 * apply(Op::lattice_noise, {x + 1.0 * n, y, z});
        return sum;
    });
    const Job job;
    for (const PictureQuality quality :
         {PictureQuality::draft, PictureQuality::normal, PictureQuality::high}) {
        SceneOptions options = scene_of(2);
        options.quality = quality;
        const auto scene = SolidScene::make(*field, options, job);
        REQUIRE(scene);
        CHECK(scene->sampled() == (quality == PictureQuality::draft));
    }
}
