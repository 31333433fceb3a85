// Implementation of vm_text.h: one pass over the text; names are looked up in an open-addressing table of
// places in it, operations by their characters as one number, so that no line allocates.
#include "frep/lang/vm_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frep/lang/limits.h"

namespace frep::lang {

namespace {

/// The characters of a name of at most eight, as one number.
constexpr std::uint64_t key_of(std::string_view name) {
    std::uint64_t key = 0;
    for (const char c : name) key = key << 8 | static_cast<unsigned char>(c);
    return key;
}

/// An operation of the text form; `build` makes its node from one or two operands.
struct VmOperation {
    constexpr VmOperation(std::string_view called, int operands,
                          NodeId (*maker)(Graph& graph, NodeId a, NodeId b))
        : name(called), key(key_of(called)), arity(operands), build(maker) {}

    std::string_view name;
    std::uint64_t key;
    int arity;
    NodeId (*build)(Graph& graph, NodeId a, NodeId b);
};

template <Op op>
NodeId unary(Graph& graph, NodeId a, NodeId) {
    return graph.make(op, {a});
}

template <Op op>
NodeId binary(Graph& graph, NodeId a, NodeId b) {
    return graph.make(op, {a, b});
}

NodeId reciprocal(Graph& graph, NodeId a, NodeId) { return graph.make(Op::div, {graph.constant(1), a}); }

NodeId modulo(Graph& graph, NodeId a, NodeId b) {
    const NodeId whole = graph.make(Op::floor, {graph.make(Op::div, {a, b})});
    return graph.make(Op::sub, {a, graph.make(Op::mul, {b, whole})});
}

/// Frequent ones first.
constexpr std::array operations{
    VmOperation{"sub", 2, binary<Op::sub>},
    VmOperation{"square", 1, unary<Op::square>},
    VmOperation{"add", 2, binary<Op::add>},
    VmOperation{"max", 2, binary<Op::max>},
    VmOperation{"min", 2, binary<Op::min>},
    VmOperation{"sqrt", 1, unary<Op::sqrt>},
    VmOperation{"mul", 2, binary<Op::mul>},
    VmOperation{"abs", 1, unary<Op::abs>},
    VmOperation{"neg", 1, unary<Op::neg>},
    VmOperation{"div", 2, binary<Op::div>},
    VmOperation{"exp", 1, unary<Op::exp>},
    VmOperation{"ln", 1, unary<Op::log>},
    VmOperation{"sin", 1, unary<Op::sin>},
    VmOperation{"cos", 1, unary<Op::cos>},
    VmOperation{"mod", 2, modulo},
    VmOperation{"tan", 1, unary<Op::tan>},
    VmOperation{"asin", 1, unary<Op::asin>},
    VmOperation{"acos", 1, unary<Op::acos>},
    VmOperation{"atan", 1, unary<Op::atan>},
    VmOperation{"atan2", 2, binary<Op::atan2>},
    VmOperation{"pow", 2, binary<Op::pow>},
    VmOperation{"recip", 1, reciprocal},
    VmOperation{"floor", 1, unary<Op::floor>},
    VmOperation{"ceil", 1, unary<Op::ceil>},
    VmOperation{"round", 1, unary<Op::round>},
};

constexpr std::array leaf_names{std::string_view("const"), std::string_view("var-x"),
                                std::string_view("var-y"), std::string_view("var-z")};

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// A word of the text with two numbers: its characters, as key_of() has them, 0 for a long word; a hash.
struct Word {
    std::string_view text;
    std::uint64_t short_key = 0;
    std::uint64_t hash = 0;
};

constexpr std::uint64_t hash_factor = 0xD6E8FEB86659FD93u;

/// The word that begins at `begin`, not a blank; it ends at the next blank or at `end`.
inline Word read_word(const char* begin, const char* end) {
    Word word;
    std::uint64_t key = 0;
    const char* at = begin;
    for (; at != end && !is_blank(*at); ++at) {
        if (((at - begin) & 7) == 0) {
            word.hash = (word.hash ^ key) * hash_factor;
            key = 0;
        }
        key = key << 8 | static_cast<unsigned char>(*at);
    }
    word.hash = (word.hash ^ key) * hash_factor;
    word.hash ^= word.hash >> 32;
    word.text = {begin, static_cast<std::size_t>(at - begin)};
    if (word.text.size() <= 8 && *begin != 0) word.short_key = key;
    return word;
}

/// Names of results and their nodes. A name is a place in the text.
class NameTable {
  public:
    NameTable(std::string_view text, std::size_t expected)
        : text_(text), slots_(std::bit_ceil(2 * expected + 16)) {}

    /// The node of `name`; nothing when it is unknown.
    const NodeId* find(const Word& name) const {
        const Slot& slot = slots_[place(name)];
        return slot.end == 0 ? nullptr : &slot.node;
    }
    /// Adds a name; false when it is there already. There is room for the expected number of names.
    bool add(const Word& name, NodeId node) {
        Slot& slot = slots_[place(name)];
        if (slot.end != 0) return false;
        const char* const end = name.text.data() + name.text.size();
        slot = {static_cast<std::uint32_t>(end - text_.data()), node};
        return true;
    }

  private:
    struct Slot {
        std::uint32_t end = 0;  ///< where the name ends in the text; 0: free
        NodeId node = 0;
    };

    std::size_t place(const Word& name) const {
        std::size_t at = name.hash & (slots_.size() - 1);
        while (slots_[at].end != 0 && !is_at(slots_[at].end, name.text)) at = (at + 1) & (slots_.size() - 1);
        return at;
    }

    /// True when the word of the text that ends at `end` is `name`. Words that differ mostly do so near
    /// their ends.
    bool is_at(std::size_t end, std::string_view name) const {
        if (name.size() > end) return false;
        const std::size_t begin = end - name.size();
        for (std::size_t i = name.size(); i-- > 0;)
            if (text_[begin + i] != name[i]) return false;
        return begin == 0 || is_blank(text_[begin - 1]) || text_[begin - 1] == '\n' ||
               text_[begin - 1] == '\r';
    }

    std::string_view text_;
    std::vector<Slot> slots_;
};

class VmTextReader {
  public:
    VmTextReader(const Source& source, Reporter& report)
        : source_(source), report_(report), names_(source.text(), source.line_count()) {
        graph_.reserve(source.line_count());
    }

    std::optional<Field> read() {
        for (std::uint32_t number = 1; number <= source_.line_count() && !report_.stopped(); ++number)
            read_line(source_.line(number));
        if (report_.errors() > 0) return std::nullopt;
        if (!result_) {
            report_.error(Code::vm_without_result, {}, {"the file has no operation", "", ""});
            return std::nullopt;
        }
        std::vector<NodeId> roots{graph_.make(Op::neg, {*result_})};
        if (graph_.over_limit()) return std::nullopt;
        Field field;
        const std::vector<bool> needed = reachable(graph_, roots);
        const bool all = std::find(needed.begin(), needed.end(), false) == needed.end();
        field.graph = std::make_shared<const Graph>(all ? std::move(graph_) : compact(graph_, roots));
        field.value = roots[0];
        field.coordinates = uses_z_ ? 3 : 2;
        return field;
    }

  private:
    /// A name, an operation and at most two operands; more are an error.
    struct Words {
        std::array<Word, 4> word;
        std::size_t count = 0;
    };

    Span span_of(std::string_view part) const {
        const auto begin = static_cast<std::uint32_t>(part.data() - source_.text().data());
        return {begin, begin + static_cast<std::uint32_t>(part.size())};
    }

    void error(Code code, std::string_view at, std::string message, std::string label, std::string help) {
        report_.error(code, span_of(at), {std::move(message), std::move(label), std::move(help)});
    }

    bool split(std::string_view line, Words& out) {
        const char* at = line.data();
        const char* const end = at + line.size();
        while (true) {
            while (at != end && is_blank(*at)) ++at;
            if (at == end || (out.count == 0 && *at == '#')) return true;
            const Word word = read_word(at, end);
            at += word.text.size();
            if (out.count == out.word.size()) {
                error(Code::vm_malformed_line, word.text, "an operation has at most two operands", "too much",
                      "a line is: name operation operands");
                return false;
            }
            out.word[out.count++] = word;
        }
    }

    void read_line(std::string_view line) {
        Words words;
        if (!split(line, words) || words.count == 0) return;
        if (words.count == 1) {
            error(Code::vm_malformed_line, words.word[0].text, "the line has a name but no operation", "",
                  "a line is: name operation operands");
            return;
        }
        const auto node = read_operation(words);
        if (!node) return;
        if (graph_.over_limit()) {
            const auto limit = fmt::format("more than {} operations", Graph::node_limit);
            report_.fatal(Code::vm_too_large, span_of(line), {limit, "the limit is reached here", ""});
            return;
        }
        if (!names_.add(words.word[0], *node)) {
            const std::string_view name = words.word[0].text;
            error(Code::vm_name_twice, name, fmt::format("{} has a value already", Reporter::quote(name)),
                  "defined again", "every name is assigned once");
            return;
        }
        result_ = *node;
    }

    std::optional<NodeId> read_operation(const Words& words) {
        const std::string_view name = words.word[1].text;
        const std::uint64_t key = words.word[1].short_key;
        graph_.set_origin(span_of(name));
        if (key == key_of("const")) return read_constant(words);
        for (const VmOperation& operation : operations) {
            if (operation.key != key) continue;
            if (!has_operands(words, operation.arity)) return std::nullopt;
            std::array<NodeId, 2> operands{};
            for (std::size_t i = 0; i < static_cast<std::size_t>(operation.arity); ++i) {
                const NodeId* found = names_.find(words.word[2 + i]);
                if (!found) return refuse_operand(words.word[2 + i].text);
                operands[i] = *found;
            }
            return operation.build(graph_, operands[0], operands[1]);
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (key != key_of(leaf_names[static_cast<std::size_t>(1 + axis)])) continue;
            if (!has_operands(words, 0)) return std::nullopt;
            uses_z_ = uses_z_ || axis == 2;
            return graph_.coordinate(axis);
        }
        return refuse_operation(name);
    }

    std::optional<NodeId> read_constant(const Words& words) {
        if (!has_operands(words, 1)) return std::nullopt;
        const std::string_view text = words.word[2].text;
        double value = 0;
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = end == text.data() + text.size() && status == std::errc();
        if (!whole || value - value != 0) {
            error(Code::vm_malformed_line, text, fmt::format("{} is no number", Reporter::quote(text)), "",
                  "a finite decimal number is expected");
            return std::nullopt;
        }
        return graph_.constant(value);
    }

    bool has_operands(const Words& words, int arity) {
        const auto given = static_cast<int>(words.count) - 2;
        if (given == arity) return true;
        const std::string_view name = words.word[1].text;
        error(Code::vm_operand_count, name,
              fmt::format("{} takes {} operand{}, not {}", Reporter::quote(name), arity,
                          arity == 1 ? "" : "s", given),
              "", "");
        return false;
    }

    std::nullopt_t refuse_operand(std::string_view name) {
        error(Code::vm_unknown_operand, name, fmt::format("{} has no value yet", Reporter::quote(name)),
              "no line before this one defines it", "");
        return std::nullopt;
    }

    std::nullopt_t refuse_operation(std::string_view name) {
        std::vector<std::string_view> known(leaf_names.begin(), leaf_names.end());
        for (const VmOperation& operation : operations) known.push_back(operation.name);
        const std::string_view near = nearest_name(name, known);
        error(Code::vm_unknown_operation, name,
              fmt::format("there is no operation {}", Reporter::quote(name)), "",
              near.empty() ? "" : fmt::format("did you mean `{}`?", near));
        return std::nullopt;
    }

    const Source& source_;
    Reporter& report_;
    NameTable names_;
    Graph graph_;
    std::optional<NodeId> result_;
    bool uses_z_ = false;
};

}  // namespace

std::optional<Field> parse_vm_text(const Source& source, Reporter& report) {
    if (source.text().size() > source_limit) {
        report.fatal(Code::vm_too_large, {},
                     {fmt::format("the file is longer than {} MiB", source_limit >> 20), "", ""});
        return std::nullopt;
    }
    return VmTextReader(source, report).read();
}

}  // namespace frep::lang
