// The library table: the rows of all groups in the order of the documentation, and look-up by name.
// Tested by tests/unit/shapes/table_test.cpp.
#include "frep/shapes/library.h"

#include <algorithm>
#include <unordered_map>

#include "frep/base/source.h"
#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace detail {

std::string_view next_name(std::string_view& names) {
    const std::size_t comma = names.find(',');
    const std::string_view name = names.substr(0, comma);
    names = comma == std::string_view::npos ? std::string_view() : names.substr(comma + 1);
    while (names.starts_with(' ')) names.remove_prefix(1);
    FREP_CHECK(!name.empty());
    return name;
}

}  // namespace detail

Expression guarded(Build& build, Expression bad, const std::string& message, Expression value) {
    if (const auto decided = build.graph.constant_value(bad.id()))
        return *decided == 0.0 ? value : build.error(message);
    return select(bad, build.constant(error_value), value);
}

std::optional<double> known(Build& build, Expression value) {
    const auto number = build.graph.bound_value(value.id());
    if (number && build.decides) build.decides(value);
    return number;
}

Expression block(Build& build, Op op, std::initializer_list<Expression> lead,
                 std::span<const Expression> data) {
    std::vector<NodeId> leading, items;
    for (const Expression& argument : lead) leading.push_back(argument.id());
    items.reserve(data.size());
    for (const Expression& item : data) items.push_back(item.id());
    return {build.graph, build.graph.make_block(op, leading, items)};
}

namespace {

struct Table {
    Rows rows;
    std::unordered_map<std::string, std::pair<std::size_t, std::size_t>> by_name;  ///< first row, count

    void add(std::string_view group, Rows added) {
        for (LibraryFunction& function : added) {
            function.group = group;
            auto& [first, count] =
                by_name.try_emplace(lower_case(function.name), rows.size(), 0).first->second;
            FREP_CHECK(first + count == rows.size());  // rows of one name are adjacent
            ++count;
            rows.push_back(std::move(function));
        }
    }

    Table() {
        add("Primitives", primitive_rows());
        add("Skeletons", skeleton_rows());
        add("Convolution", convolution_rows());
        add("Free-form volumes", freeform_rows());
        add("Transformations", transform_rows());
        add("Transformations", affine_rows());
        add("Deformations", deformation_rows());
        add("Arrays of copies", pattern_rows());
        add("Set operations", set_operation_rows());
        add("Blends", blend_rows());
        add("Blends by points", control_point_rows());
        add("Offsets", offset_rows());
        add("Metamorphosis", metamorphosis_rows());
        add("Metamorphosis", radial_morph_rows());
        add("Polygons", polygon_rows());
        add("Outlines", outline_rows());
        add("Voxel files", volume_rows());
        add("Extrema", extremum_rows());
        add("Sweeps", sweep_rows());
        add("Distance", distance_rows());
        add("Noise", noise_rows());
        add("Noise", hypertexture_rows());
        add("Attributes", attribute_rows());
        add("Attribute tables", attribute_table_rows());
    }
};

const Table& table() {
    static const Table instance;
    return instance;
}

}  // namespace

std::span<const LibraryFunction> library() { return table().rows; }

std::span<const LibraryFunction> find_functions(std::string_view name) {
    const auto found = table().by_name.find(lower_case(name));
    if (found == table().by_name.end()) return {};
    return std::span(table().rows).subspan(found->second.first, found->second.second);
}

}  // namespace frep::shapes
