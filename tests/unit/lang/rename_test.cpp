// Models with renamed objects: names change wherever they stand, nothing else does, and the shape stays.
#include "frep/lang/rename.h"

#include <doctest/doctest.h>

#include "frep/lang/model.h"

using namespace frep;

TEST_CASE("names of objects change in headers, bodies and calls; comments and other names stay") {
    const std::string text =
        "--@ title Ball\n"
        "-- ball, not renamed in a comment\n"
        "Ball(x[3], a[1])\n"
        "{\n"
        "  balls = 1;  -- another name\n"
        "  bALL = balls - x[1]^2 - x[2]^2;\n"
        "}\n"
        "my_model(x[3], a[1])\n"
        "{\n"
        "  my_model = ball(x, a) | BALL(x, a);\n"
        "}\n";
    const Model model(Source("ball.hf", text));
    REQUIRE(model.ok());
    CHECK(lang::with_renamed_objects(model.source(), model.program(), "first_") ==
          "-- title Ball\n"
          "-- ball, not renamed in a comment\n"
          "first_Ball(x[3], a[1])\n"
          "{\n"
          "  balls = 1;  -- another name\n"
          "  first_bALL = balls - x[1]^2 - x[2]^2;\n"
          "}\n"
          "first_my_model(x[3], a[1])\n"
          "{\n"
          "  first_my_model = first_ball(x, a) | first_BALL(x, a);\n"
          "}\n");
}

TEST_CASE("a renamed model is the same function") {
    const std::string text =
        "part(x[2], a[1]) { part = a[1] - x[1]*x[2]; }\nmy_model(x[2], a[1]) { my_model = part(x, a) & "
        "part(x, a); }";
    const Model model(Source("m.hf", text));
    const Model renamed(Source("r.hf", lang::with_renamed_objects(model.source(), model.program(), "q_")));
    REQUIRE(renamed.ok());
    CHECK(!renamed.find_object("part"));
    REQUIRE(renamed.find_object("q_my_model"));
    const auto before = model.field("my_model"), after = renamed.field("q_my_model");
    REQUIRE(before);
    REQUIRE(after);
    CHECK(before->graph->size() == after->graph->size());
}
