// Regions over boxes: the program of a region (field/region.h) run once for all points of a box, with an
// interval in every cell. One executor serves all engines, so that their enclosures are the same.
//
// Method: abstract interpretation without widening (P. and R. Cousot, POPL 1977). A condition that is the
// same for all points takes one side; an undecided one runs both, each with the cells narrowed to what the
// condition says there (region_narrow.h), and the stores are joined cell by cell. An undecided loop condition
// sets the store aside as one that may leave and goes on with those that stay; what leaves is joined. Points
// whose condition is undefined or that take too many steps are undefined as a whole, which the flag of every
// result says. Work is bounded: beyond the limits below the answer is "anything, maybe undefined". Searches
// are done by box_search.h, for boxes as for single points, so that all engines find the same places. Tested
// by tests/unit/eval/region_interval_test.cpp and region_search_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "frep/eval/box_search.h"
#include "frep/field/region.h"
#include "frep/math/interval.h"

namespace frep {

class IntervalRegion {
  public:
    /// Undecided conditions in one run; nodes of expressions and cells of memory touched in one run; cells of
    /// a region. Beyond them nothing is known.
    static constexpr int undecided_limit = 256;
    static constexpr std::int64_t work_limit = std::int64_t{1} << 18;
    static constexpr std::uint32_t cell_limit = 4096;
    /// The same work for all statements inside the search of a single point.
    static constexpr std::int64_t search_work_limit = std::int64_t{1} << 24;
    /// Boxes and points that one search over a box of space looks at.
    static constexpr int coarse_search_limit = 96;
    /// BoxSearchOptions::looseness of it.
    static constexpr double coarse_search_looseness = 0.25;

    /// `region` must outlive the object.
    IntervalRegion(const Region& region, std::int64_t max_steps);

    /// Runs on guard and start values; cells() then encloses the final contents for every point.
    void run(std::span<const math::Interval> arguments);
    const std::vector<math::Interval>& cells() const { return state_.cells; }

    /// For an engine that runs the region at a point: carries out the search statement `number` there.
    /// `content(cell)` is what the engine has in a cell. `spent` counts the boxes and points looked at by the
    /// searches of the point.
    template <class Content>
    BoxSearchResult search_at(std::uint32_t number, Content content, int& spent) {
        start_search(number);
        for (const std::uint32_t cell : cells_read_) state_.cells[cell] = math::Interval(content(cell));
        searched_ = spent;
        const BoxSearchResult result = run_search(number);
        spent = searched_;
        return result;
    }

  private:
    /// What the points that are at one place of the program have in memory.
    struct State {
        std::vector<math::Interval> cells;
        std::int64_t fewest_steps = 0, most_steps = 0;
        bool reached = true;  ///< false: no point is here, and the rest says nothing
    };
    /// The sides that a condition may take, and what is known about it: its node and the assignments made
    /// since the nodes below it were computed (see narrow()).
    struct Sides {
        bool first = false, second = false;
        NodeId node = 0;
        std::span<const std::pair<std::uint32_t, NodeId>> assigned;
    };

    void execute(std::span<const std::uint32_t> statements);
    void branch(const RegionStatement& statement, std::uint32_t number);
    void loop(const RegionStatement& statement, std::uint32_t number);
    void store(const RegionStatement& statement);
    void search(const RegionStatement& statement, std::uint32_t number);
    void start_search(std::uint32_t number);
    BoxSearchResult run_search(std::uint32_t number);
    Slope slope(std::uint32_t number, std::span<const math::Interval> box);
    math::Interval value_after(const RegionStatement& statement, std::uint32_t number,
                               std::span<const math::Interval> box);
    struct SearchedNodes {
        std::vector<NodeId> fixed, moving;  ///< ascending
        std::vector<std::pair<NodeId, RoundedMinimum>> rounded;
    };
    bool slope_of_rounded(const SearchedNodes& nodes, NodeId id, std::size_t variables, bool curved);
    void slope_of_node(const RegionStatement& statement, NodeId id, std::span<const math::Interval> box,
                       bool curved);
    Sides decide(const RegionStatement& statement, std::uint32_t number);
    void keep(State& state, const Sides& sides, bool truth) const;
    void evaluate(std::uint32_t number);
    math::Interval load(const Node& node, math::Interval index);
    void join(State& into, const State& other);
    void work(std::size_t amount);

    const Region& region_;
    std::int64_t max_steps_;
    std::vector<std::vector<NodeId>> needed_;  ///< by statement: nodes of body, ascending
    State state_;
    std::vector<math::Interval> values_, arguments_;
    const RegionStatement* latest_ = nullptr;  ///< the assignment just made, nothing after anything else
    bool may_fail_ = false;                    ///< some point may be undefined as a whole
    bool given_up_ = false;                    ///< a limit is reached
    int undecided_ = 0;
    std::int64_t work_ = 0, most_work_ = work_limit;

    class Searched;
    const SearchedNodes& nodes_of_search(std::uint32_t number);
    std::vector<SearchedNodes> searched_nodes_;  ///< by statement, made when they are needed
    std::vector<std::uint32_t> cells_read_;      ///< by the search of search_at()
    std::uint32_t read_by_ = ~std::uint32_t{0};
    std::vector<Slope> slopes_;  ///< by node
    std::vector<const Slope*> slope_arguments_;
    bool at_a_point_ = false;  ///< all ranges are single numbers: searches are done to their end
    int searched_ = 0;         ///< boxes and points that searches looked at
};

}  // namespace frep
