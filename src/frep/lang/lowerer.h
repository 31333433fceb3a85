// Lowerer: the state of one lowering, private to lower*.cpp.
//
// Values are nodes of the present target's graph. The outermost target is the model's graph; inside a loop
// that depends on the point the target is a region: nodes of the region's body graph, and statements that
// change its cells. A node of a body graph means its value for the memory as it stands, so before a statement
// may change memory all values that are still needed are moved into cells (flush).
#pragma once

#include <map>
#include <memory>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "frep/lang/effects.h"
#include "frep/lang/limits.h"
#include "frep/lang/lower.h"

namespace frep::lang {

/// Marks a variable or item that has not been assigned.
inline constexpr NodeId unassigned = ~NodeId{0};
inline constexpr std::uint32_t no_cell = ~std::uint32_t{0};

/// Items of an array; shared until written.
class Items {
  public:
    Items() : items_(std::make_shared<std::vector<NodeId>>()) {}
    explicit Items(std::vector<NodeId> items)
        : items_(std::make_shared<std::vector<NodeId>>(std::move(items))) {}
    std::size_t size() const { return items_->size(); }
    NodeId operator[](std::size_t i) const { return (*items_)[i]; }
    const std::vector<NodeId>& all() const { return *items_; }
    std::vector<NodeId>& writable() {
        if (items_.use_count() > 1) items_ = std::make_shared<std::vector<NodeId>>(*items_);
        return *items_;
    }
    bool shares(const Items& other) const { return items_ == other.items_; }

  private:
    std::shared_ptr<std::vector<NodeId>> items_;
};

/// The variables of one object being evaluated.
struct Frame {
    const Object* object = nullptr;
    std::vector<NodeId> scalars;
    std::vector<Items> arrays;
    std::vector<std::uint32_t> scalar_cells;  ///< in a region: home cell of a scalar, or no_cell
    std::vector<std::uint32_t> array_homes;   ///< in a region: number of its RegionArray, or no_cell
    NodeId result = unassigned;
};

/// Where nodes and statements go.
struct Target {
    Graph* graph = nullptr;
    Region* region = nullptr;                          ///< null for the model's graph
    std::vector<std::uint32_t>* statements = nullptr;  ///< the list that grows; null for the model's graph
    std::size_t first_frame = 0;                       ///< frames from here on live in this target
    std::size_t first_pending = 0;  ///< pending operands from here on belong to this target
    int nesting = 0;                ///< levels of branch and loop in the region
};

class Lowerer {
  public:
    Lowerer(const Program& program, const LowerOptions& options, Diagnostics& diagnostics)
        : program_(program), options_(options), diagnostics_(diagnostics), effects_(program) {}

    std::optional<Lowered> run(std::size_t object);

  private:
    // expressions (lower_expressions.cpp)
    NodeId evaluate(ExpressionId id);
    NodeId evaluate_kind(const ExpressionNode& node);
    NodeId read_scalar(const ExpressionNode& node);
    NodeId read_item(const ExpressionNode& node);
    NodeId unary(const ExpressionNode& node);
    NodeId chain(const ExpressionNode& node);
    NodeId combine(Operator op, NodeId a, NodeId b);
    NodeId builtin(const ExpressionNode& node);
    /// Evaluates operands from last to first onto pending_; answers where the first one lies.
    std::size_t push_operands(const std::vector<ExpressionId>& operands);
    /// A value that exists nowhere because of a variable read before it was assigned.
    NodeId unassigned_value(Span span, const std::string& name);
    /// The value if it is known now; parameters that it depends on become structural.
    std::optional<double> known(NodeId id);
    void mark_structural(NodeId id);

    // calls (lower_calls.cpp)
    NodeId library_call(const ExpressionNode& node);
    NodeId object_call(const ExpressionNode& node);
    NodeId inline_object(std::uint32_t object, Items x, Items a, Items& s);
    /// The content of a file that the model names; one that cannot be read is an error at `span`.
    Result<std::string> read_file(std::string_view name, Span span);
    bool all_assigned(const Items& items, const ArrayInfo& info, Span span);
    void poison(Items& items);

    // statements (lower_statements.cpp)
    void execute(const std::vector<StatementId>& statements);
    void execute(const StatementNode& statement, StatementId id);
    void assign_item(const StatementNode& statement);
    void assign_computed_item(const StatementNode& statement, NodeId value, NodeId index);
    void branch(const StatementNode& statement);
    void branch_select(const StatementNode& statement, NodeId condition);
    void merge_frames(Frame& out, const Frame& first, const Frame& second, NodeId condition);
    NodeId merge(NodeId condition, NodeId a, NodeId b);
    void loop(const StatementNode& statement, StatementId id);
    enum class Unrolled { done, depends_on_point, too_long, stopped };
    Unrolled unroll(const StatementNode& statement, StatementId id);
    void refuse_loop(const StatementNode& statement, NodeId condition, std::int64_t steps);
    bool never_ends(const StatementNode& statement, StatementId id);
    /// Makes every variable that the statement may write undefined.
    void forget_written(StatementId id);

    // regions (lower_region.cpp)
    void region(const StatementNode& statement, StatementId id);
    void import_frame(const Frame& outer, const Effects& effects, Frame& inner, std::vector<NodeId>& inputs);
    NodeId import_node(NodeId outer, std::vector<NodeId>& inputs);
    void region_loop(const StatementNode& statement, StatementId id);
    void region_branch(const StatementNode& statement, NodeId condition);
    void region_store(const StatementNode& statement, NodeId value, NodeId index);
    using Moves = std::vector<std::pair<std::uint32_t, NodeId>>;  ///< cell, node of the body graph
    /// Moves every value that depends on memory, and the current frame's variables written by `forced`, into
    /// cells of their own, together with `moves`, in one statement.
    void flush(const Effects* forced, Moves moves = {});
    void flush_scalars(Frame& frame, const Effects* forced, Moves& moves);
    void flush_array(Frame& frame, std::uint32_t array, bool forced, Moves& moves);
    /// True for a value that no statement of the region can change.
    bool is_steady(NodeId id) const;
    std::uint32_t new_steady_cell();
    std::vector<Frame> region_frames() const;
    void restore_frames(std::vector<Frame> frames);
    std::uint32_t new_cell() { return target_.region->cell_count++; }
    std::uint32_t home_of_array(Frame& frame, std::size_t array);
    void add_statement(RegionStatement statement);
    bool may_nest();

    /// Variables of searches that are left outside of them, as errors.
    void report_variables(const Graph& model, std::span<const NodeId> roots);

    // bookkeeping
    Frame& frame() { return frames_.back(); }
    Graph& graph() { return *target_.graph; }
    bool in_region() const { return target_.region != nullptr; }
    NodeId constant(double value) { return graph().constant(value); }
    NodeId make(Op op, std::initializer_list<NodeId> args) { return graph().make(op, args); }
    Expression expression(NodeId id) { return {graph(), id}; }
    const shapes::SetSystem& set_system() const { return program_.annotations.set_operations; }
    bool stopped() const { return stopped_; }
    /// Counts work; stops the lowering with a diagnostic beyond the limit.
    bool step(std::int64_t count = 1);
    void stop(const char* code, const std::string& message, const std::string& help);
    void report(Severity severity, const char* code, Span span, const std::string& message,
                const std::string& label, const std::string& help);
    Frame make_frame(const Object& object);

    /// Everything that an attempt to unroll may change.
    struct Snapshot {
        std::size_t graph_size, statement_count, list_size, array_count;
        std::uint32_t cell_count;
        std::vector<Frame> frames;
        std::vector<NodeId> pending;
    };
    Snapshot take_snapshot();
    void restore(const Snapshot& snapshot);
    void forget_memo_from(std::size_t graph_size);
    /// Drops nodes made since `size` when all of them are constants, keeping those that variables hold.
    bool drop_constants_since(std::size_t size);

    /// A finished call of an object: its result and the attributes after it.
    struct Call {
        std::uint32_t object;
        std::vector<NodeId> arguments;
        NodeId result;
        Items attributes;
        NodeId newest;  ///< largest node number among result, attributes and guard
        /// Guard of the regions that the call made: the call stands for later ones under the same guard only.
        NodeId guard;
    };

    const Program& program_;
    const LowerOptions& options_;
    Diagnostics& diagnostics_;
    EffectsTable effects_;

    Target target_;
    const Graph* outer_graph_ = nullptr;  ///< in a region: the graph that the region node goes into
    std::vector<Frame> frames_;
    std::vector<NodeId> pending_;  ///< operands already evaluated, protected by flush()
    std::unordered_multimap<std::uint64_t, Call> memo_;
    NodeId guard_ = 0;   ///< node of the model's graph: 1 where the present statement runs
    int selecting_ = 0;  ///< branches around the present statement that become selections
    std::unordered_map<NodeId, std::uint32_t> imports_;  ///< node of the model's graph -> cell that holds it
    std::unordered_set<std::uint32_t> steady_cells_;     ///< cells written once, before every use
    int depth_ = 0;      ///< expressions, statements and calls inside one another
    int uncertain_ = 0;  ///< branches around the present statement that depend on the point or a parameter
    std::unordered_set<StatementId> never_unroll_;
    std::vector<bool> structural_;
    std::vector<bool> structural_seen_;
    std::set<std::string> functions_;
    std::set<std::pair<std::string, std::uint32_t>> reported_;
    std::int64_t steps_ = 0;
    std::size_t operations_ = 0;
    std::int64_t guarded_uses_ = 0;  ///< regions made in the model's graph, and uses of calls that made some
    bool stopped_ = false;
};

}  // namespace frep::lang
