#include "frep/field/copy.h"

#include <doctest/doctest.h>

#include "frep/field/expression.h"

using namespace frep;

TEST_CASE("a copy uses equal nodes again, and keeps their places") {
    Graph from;
    from.set_origin({3, 7});
    const Expression x(from, from.coordinate(0)), y(from, from.coordinate(1));
    const Expression f = x * y + sqrt(x);
    Graph to;
    const NodeId first = copy_of_root(to, from, f.id());
    const std::size_t size = to.size();
    CHECK(copy_of_root(to, from, f.id()) == first);
    CHECK(to.size() == size);
    CHECK(to.node(first).op == Op::add);
    CHECK(to.origin(first).begin == 3);
    CHECK(to.origin(first).end == 7);
}

TEST_CASE("what is replaced changes what is above it, and constants fold") {
    Graph from;
    const Expression x(from, from.coordinate(0)), y(from, from.coordinate(1));
    const Expression f = x * x + y;
    Graph to;
    const NodeId copy =
        copy_of_root(to, from, f.id(), [&](NodeId id, std::span<const NodeId>) -> std::optional<NodeId> {
            if (id == x.id()) return to.constant(3);
            return std::nullopt;
        });
    REQUIRE(to.node(copy).op == Op::add);
    bool has_nine = false;
    for (const NodeId argument : to.arguments(copy))
        has_nine = has_nine || to.constant_value(argument) == 9.0;
    CHECK(has_nine);
    // a node may be made of the copies of its arguments
    const NodeId other =
        copy_of_root(to, from, f.id(), [&](NodeId id, std::span<const NodeId> a) -> std::optional<NodeId> {
            if (from.node(id).op != Op::add) return std::nullopt;
            return to.make(Op::max, {a[0], a[1]});
        });
    CHECK(to.node(other).op == Op::max);
}
