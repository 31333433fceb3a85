// Implementation of space_field.h: one pass over the graph.
#include "frep/measure/space_field.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

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
    std::vector<NodeId> made(from.size(), 0), arguments;
    std::vector<std::uint32_t> block_names;
    const NodeId roots[] = {bound.value};
    const std::vector<bool> needed = reachable(from, roots);
    for (NodeId id = 0; id < from.size(); ++id) {
        if (!needed[id]) continue;
        to.set_origin(from.origin(id));
        const Node& node = from.node(id);
        if (node.op == Op::coordinate) {
            if (node.payload >= map.coordinates.size())
                return wrong(fmt::format("the model uses coordinate {} of {}", node.payload + 1,
                                         map.coordinates.size()));
            const MappedCoordinate& c = map.coordinates[node.payload];
            made[id] = c.axis < 0 ? to.constant(c.value) : to.coordinate(c.axis);
            continue;
        }
        arguments.clear();
        for (const NodeId argument : from.arguments(id)) arguments.push_back(made[argument]);
        made[id] = to.make_as(from, id, arguments, block_names);
    }
    if (to.over_limit()) return Error{ErrorKind::over_limit, "the model has too many operations"};
    Field out;
    out.value = made[bound.value];
    out.coordinates = 3;
    out.parameters = bound.parameters;
    out.graph = std::make_shared<const Graph>(std::move(to));
    return out;
}

}  // namespace frep
