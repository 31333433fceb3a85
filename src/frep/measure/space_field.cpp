// Implementation of space_field.h: one pass over the graph.
#include "frep/measure/space_field.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frep/field/copy.h"

namespace frep {

namespace {

Error wrong(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }

Status check_map(const Field& field, const AxisMap& map) {
    const auto entries = static_cast<int>(map.coordinates.size());
    if (entries != field.coordinates)
        return wrong(
            fmt::format("the map has {} entries for a model of {} coordinates", entries, field.coordinates));
    for (const MappedCoordinate& c : map.coordinates) {
        if (c.axis < -1 || c.axis > 2) return wrong("the map names an axis other than x, y and z");
        if (!(c.value - c.value == 0)) return wrong("a frozen coordinate is not a finite number");
    }
    return {};
}

}  // namespace

Result<Field> field_in_space(const Field& field, const AxisMap& map) {
    if (const Status status = check_map(field, map); !status) return status.error();
    Field plain = field;
    plain.attributes.clear();
    const Field bound = bind_parameters(plain);
    const Graph& from = *bound.graph;
    Graph to;
    std::optional<std::uint32_t> missing;
    const NodeId root =
        copy_of_root(to, from, bound.value, [&](NodeId id, std::span<const NodeId>) -> std::optional<NodeId> {
            const Node& node = from.node(id);
            if (node.op != Op::coordinate) return std::nullopt;
            if (node.payload >= map.coordinates.size()) {
                missing = node.payload;
                return to.constant(0);
            }
            const MappedCoordinate& c = map.coordinates[node.payload];
            return c.axis < 0 ? to.constant(c.value) : to.coordinate(c.axis);
        });
    if (missing)
        return wrong(fmt::format("the model uses coordinate {} of {}", *missing + 1, map.coordinates.size()));
    if (to.over_limit()) return Error{ErrorKind::over_limit, "the model has too many operations"};
    Field out;
    out.value = root;
    out.coordinates = 3;
    out.parameters = bound.parameters;
    out.graph = std::make_shared<const Graph>(std::move(to));
    return out;
}

}  // namespace frep
