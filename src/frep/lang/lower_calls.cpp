// Lowering of calls: library functions build nodes; objects are inlined, equal calls once. See lowerer.h.
#include <fmt/format.h>

#include "frep/lang/lowerer.h"

namespace frep::lang {
namespace {

std::uint64_t hash_call(std::uint32_t object, const std::vector<NodeId>& arguments) {
    std::uint64_t h = object;
    for (NodeId id : arguments) h = (h ^ id) * 0x9E3779B97F4A7C15u + (h >> 29);
    return h;
}

}  // namespace

bool Lowerer::all_assigned(const Items& items, const ArrayInfo& array, Span span) {
    for (std::size_t k = 0; k < items.size(); ++k) {
        if (items[k] != unassigned) continue;
        report(Severity::warning, "HF108", span, fmt::format("`{}[{}]` has no value here", array.name, k + 1),
               "this array is passed before all its items are assigned",
               "assign every item first; until then the result of the call is undefined");
        return false;
    }
    return true;
}

void Lowerer::poison(Items& items) {
    for (NodeId& item : items.writable()) item = graph().undefined();
}

Result<std::string> Lowerer::read_file(std::string_view name, Span span) {
    const Error none{ErrorKind::io, "this model has no folder to read files from"};
    auto content = options_.read_file ? options_.read_file(name) : Result<std::string>(none);
    if (!content)
        report(Severity::error, "HF109", span, content.error().message, "named here",
               "files lie in the model's folder or below; links are not followed");
    return content;
}

NodeId Lowerer::library_call(const ExpressionNode& node) {
    const shapes::LibraryFunction& function = *node.function;
    const std::size_t count = node.operands.size();
    functions_.insert(std::string(function.name));
    const std::size_t base = pending_.size();
    for (std::size_t i = count; i-- > 0;)
        if (function.arguments[i].kind == shapes::ArgumentKind::number)
            pending_.push_back(evaluate(node.operands[i]));
    if (stopped()) return pending_.resize(base), constant(0);

    std::vector<shapes::ArgumentValue> values(count);
    std::size_t next = pending_.size();
    bool assigned = true;
    for (std::size_t i = 0; i < count; ++i) {
        const ExpressionNode& operand = program_.expressions[node.operands[i]];
        const shapes::ArgumentKind kind = function.arguments[i].kind;
        if (kind == shapes::ArgumentKind::number) {
            values[i].number = Expression(graph(), pending_[--next]);
        } else if (kind == shapes::ArgumentKind::text) {
            values[i].text = program_.texts[operand.symbol];
        } else {
            const Items& items = frame().arrays[operand.symbol];
            assigned &= all_assigned(items, frame().object->arrays[operand.symbol], operand.span);
            for (NodeId id : items.all()) values[i].items.emplace_back(graph(), id == unassigned ? 0 : id);
        }
    }
    pending_.resize(base);
    NodeId result = unassigned;
    if (assigned) {
        shapes::Build build{graph(), {}, {}};
        build.read_file = [&](std::string_view name) { return read_file(name, node.span); };
        build.warn = [&](const std::string& message) {
            report(Severity::warning, "HF105", node.span, message, "in this call",
                   fmt::format("the value is then {:.0f}, as in the old tools", shapes::error_value));
        };
        build.refuse = [&](const std::string& message) {
            report(Severity::error, "HF109", node.span, message, "named here",
                   "`frep explain HF109` says which files a model may name");
        };
        build.left_out = [&](const std::string& message) {
            report(Severity::warning, "HF109", node.span, message, "named here",
                   "the rest of the file is used");
        };
        build.refuse_search = [&](const std::string& message) {
            report(Severity::error, "HF113", node.span, message, "in this search",
                   "`frep explain HF113` says what a search needs");
        };
        build.decides = [&](Expression value) { known(value.id()); };
        build.set_system = set_system();
        const std::size_t before = graph().size();
        result = function.invoke(build, values).id();
        step(static_cast<std::int64_t>(graph().size() - before));
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (function.arguments[i].kind != shapes::ArgumentKind::array_in_out) continue;
        Items& items = frame().arrays[program_.expressions[node.operands[i]].symbol];
        std::vector<NodeId>& out = items.writable();
        for (std::size_t k = 0; k < out.size(); ++k)
            out[k] = assigned ? values[i].items[k].id() : graph().undefined();
        step(static_cast<std::int64_t>(out.size()));
    }
    return assigned ? result : graph().undefined();
}

NodeId Lowerer::object_call(const ExpressionNode& node) {
    Frame& caller = frame();
    const Object& callee = program_.objects[node.symbol];
    std::vector<std::uint32_t> arrays;
    bool assigned = true;
    for (ExpressionId id : node.operands) {
        const ExpressionNode& operand = program_.expressions[id];
        arrays.push_back(operand.symbol);
        assigned &=
            all_assigned(caller.arrays[operand.symbol], caller.object->arrays[operand.symbol], operand.span);
    }
    const bool passes_attributes = arrays.size() == 3;
    // Called with two arguments, the callee's s starts at 0 and is the caller's own s[1] where that is a
    // single item.
    const bool shares_attributes = !passes_attributes && caller.object->attributes() == 1;
    if (!assigned) {
        if (passes_attributes) poison(caller.arrays[arrays[2]]);
        return graph().undefined();
    }
    Items attributes =
        passes_attributes
            ? caller.arrays[arrays[2]]
            : Items(std::vector<NodeId>(static_cast<std::size_t>(callee.attributes()), constant(0)));
    const NodeId result =
        inline_object(node.symbol, caller.arrays[arrays[0]], caller.arrays[arrays[1]], attributes);
    // inline_object may have moved the frames
    if (passes_attributes) frame().arrays[arrays[2]] = attributes;
    if (shares_attributes) frame().arrays[array_s] = attributes;
    return result;
}

NodeId Lowerer::inline_object(std::uint32_t object, Items x, Items a, Items& s) {
    std::vector<NodeId> arguments(x.all());
    arguments.insert(arguments.end(), a.all().begin(), a.all().end());
    arguments.insert(arguments.end(), s.all().begin(), s.all().end());
    if (!step(1 + static_cast<std::int64_t>(arguments.size() / 8))) return constant(0);
    const std::uint64_t key = hash_call(object, arguments);
    const auto [first, last] = memo_.equal_range(key);
    for (auto i = first; i != last; ++i) {
        const Call& known_call = i->second;
        if (known_call.object != object || known_call.arguments != arguments) continue;
        if (known_call.guard != unassigned && known_call.guard != guard_) continue;
        if (known_call.guard != unassigned) ++guarded_uses_;
        s = known_call.attributes;
        return known_call.result;
    }
    if (frames_.size() > static_cast<std::size_t>(call_depth_limit)) {
        stop("HF103", fmt::format("more than {} objects call one another in a row", call_depth_limit),
             "combine some of the objects");
        return constant(0);
    }
    const std::size_t statements = in_region() ? target_.region->statements.size() : 0;
    const std::size_t arrays_before = in_region() ? target_.region->arrays.size() : 0;
    const std::int64_t guarded_before = guarded_uses_;
    Frame callee = make_frame(program_.objects[object]);
    callee.arrays[array_x] = std::move(x);
    callee.arrays[array_a] = std::move(a);
    callee.arrays[array_s] = s;
    frames_.push_back(std::move(callee));
    execute(program_.objects[object].body);
    const NodeId result = frame().result;
    s = frame().arrays[array_s];
    frames_.pop_back();
    if (stopped() || result == unassigned) return constant(0);

    // A call that changed the region's memory on its way is not the same at another place of the program.
    const bool pure = !in_region() || (statements == target_.region->statements.size() &&
                                       arrays_before == target_.region->arrays.size());
    if (pure) {
        NodeId newest = result;
        for (const std::vector<NodeId>* list :
             {static_cast<const std::vector<NodeId>*>(&arguments), &s.all()})
            for (NodeId id : *list) newest = std::max(newest, id == unassigned ? 0 : id);
        const NodeId guard = guarded_before == guarded_uses_ ? unassigned : guard_;
        if (guard != unassigned) newest = std::max(newest, guard);
        memo_.emplace(key, Call{object, std::move(arguments), result, s, newest, guard});
    }
    return result;
}

}  // namespace frep::lang
