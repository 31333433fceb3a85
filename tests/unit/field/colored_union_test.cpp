// The union of colored parts: frozen coordinates, parameters, which color wins where.
#include "frep/field/colored_union.h"

#include <doctest/doctest.h>

#include <memory>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;

namespace {

/// A disc of radius a[1] that moves along x with the third coordinate.
Field moving_disc(double radius) {
    auto graph = std::make_shared<Graph>();
    const Expression x(*graph, graph->coordinate(0)), y(*graph, graph->coordinate(1)),
        t(*graph, graph->coordinate(2)), r(*graph, graph->parameter(0));
    Field out;
    out.value = (square(r) - square(x - t) - square(y)).id();
    out.graph = graph;
    out.coordinates = 3;
    out.parameters = {radius};
    return out;
}

/// The field's graph, to be evaluated through expressions.
Graph copy_of(const Field& field) {
    std::vector<NodeId> renamed(field.graph->size());
    return field.graph->copy_of(std::vector<bool>(renamed.size(), true), renamed);
}

}  // namespace

TEST_CASE("each part stands where its frozen coordinate puts it, in its color") {
    const std::vector<ColoredPart> parts = {{moving_disc(1), {{2, -3.0}}, {1, 0, 0}},
                                            {moving_disc(0.5), {{2, 0.0}}, {0, 1, 0}},
                                            {moving_disc(2), {{2, 4.0}}, {0, 0, 1}}};
    const Field field = colored_union(parts);
    CHECK(field.coordinates == 3);
    CHECK(field.parameters.empty());
    REQUIRE(field.attributes.size() == 3);
    Graph graph = copy_of(field);
    const auto value = [&](NodeId node, double x, double y) {
        return at(Expression(graph, node), x, y, 77);  // the third coordinate counts no more
    };
    struct {
        double x, y, f;
        double color[3];
    } const expected[] = {
        {-3, 0, 1, {1, 0, 0}},     {-3.9, 0, 0.19, {1, 0, 0}}, {0.3, 0, 0.16, {0, 1, 0}},
        {4, 1.5, 1.75, {0, 0, 1}}, {4, 2.5, -2.25, {0, 0, 1}},
    };
    for (const auto& e : expected) {
        CAPTURE(e.x);
        CHECK(value(field.value, e.x, e.y) == doctest::Approx(e.f));
        for (std::size_t k = 0; k < 3; ++k) CHECK(value(field.attributes[k], e.x, e.y) == e.color[k]);
    }
}

TEST_CASE("of equal parts the first one has its color") {
    const std::vector<ColoredPart> parts = {{moving_disc(1), {{2, 0.0}}, {0.25, 0.5, 0.75}},
                                            {moving_disc(1), {{2, 0.0}}, {1, 1, 1}}};
    const Field field = colored_union(parts);
    Graph graph = copy_of(field);
    CHECK(at(Expression(graph, field.attributes[0]), 0.2, 0.1, 0) == 0.25);
}
