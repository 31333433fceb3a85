// Implementation of native_order.h.
#include "frep/eval/native_order.h"

#include <algorithm>
#include <array>

namespace frep::native {
namespace {

constexpr std::uint32_t window = 96, steps_a_cycle = 3;

/// Cycles until a result can be used, roughly.
std::uint32_t latency_of(StepOp op) {
    switch (op) {
        case StepOp::divide:
            return 14;
        case StepOp::square_root:
            return 20;
        case StepOp::bit_and:
        case StepOp::bit_or:
        case StepOp::bit_xor:
        case StepOp::word_add:
        case StepOp::word_subtract:
        case StepOp::shift_left:
        case StepOp::shift_right:
        case StepOp::choose:
            return 1;
        case StepOp::compare:
        case StepOp::low_bit:
        case StepOp::patch:
            return 4;
        default:
            return 3;
    }
}

class Scheduler {
  public:
    Scheduler(const StepList& list, const std::vector<ValueId>& steps, std::uint32_t vectors,
              std::uint32_t masks)
        : list_(list), steps_(steps), limit_{vectors, masks}, masks_apart_(masks != 0) {
        const std::size_t count = list.steps().size();
        uses_.assign(count, 0);
        ready_.assign(count, 0);
        for (const ValueId v : steps) ready_[v] = not_yet;
        for (const ValueId v : steps)
            for (const ValueId in : list.operands_of(list.steps()[v])) ++uses_[in];
    }

    std::vector<ValueId> run() {
        std::vector<ValueId> order;
        order.reserve(steps_.size());
        while (fill(), !waiting_.empty()) {
            std::uint32_t issued = 0;
            while (issued < steps_a_cycle && !waiting_.empty()) {
                const std::size_t at = choose();
                if (at == none) break;
                issue(waiting_[at].step);
                order.push_back(waiting_[at].step);
                waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(at));
                ++issued;
            }
            ++cycle_;
        }
        return order;
    }

  private:
    static constexpr std::uint32_t not_yet = ~0u;
    static constexpr std::size_t none = ~std::size_t{0};

    struct Waiting {
        ValueId step;
        std::uint32_t begin = not_yet;  ///< the cycle when its operands are there, once known
        ValueId missing = no_value;     ///< an operand that was not written yet
    };

    void fill() {
        while (waiting_.size() < window && next_ < steps_.size()) waiting_.push_back({steps_[next_++]});
    }
    std::size_t class_of(ValueId v) const { return masks_apart_ && is_mask(list_.steps()[v].op) ? 1 : 0; }

    /// The first step that can begin now and for which there are registers; under pressure the first that
    /// needs no more than before, and at last the first of all.
    std::size_t choose() {
        const bool tight = alive_[0] >= limit_[0] || (masks_apart_ && alive_[1] >= limit_[1]);
        for (std::size_t i = 0; i < waiting_.size(); ++i) {
            if (!can_begin(waiting_[i])) continue;
            if (!tight || !grows(waiting_[i].step)) return i;
        }
        // Nothing helps: go on in the given order, whose first step has all its operands.
        return tight ? 0 : none;
    }
    bool can_begin(Waiting& w) const {
        if (w.begin != not_yet) return w.begin <= cycle_;
        if (w.missing != no_value && ready_[w.missing] == not_yet) return false;
        std::uint32_t begin = 0;
        for (const ValueId in : list_.operands_of(list_.steps()[w.step])) {
            if (ready_[in] == not_yet) {
                w.missing = in;
                return false;
            }
            begin = std::max(begin, ready_[in]);
        }
        w.begin = begin;
        return begin <= cycle_;
    }
    bool grows(ValueId v) const {
        std::array<int, 2> change{};
        change[class_of(v)] += 1;
        const auto in = list_.operands_of(list_.steps()[v]);
        for (std::size_t k = 0; k < in.size(); ++k) {
            const auto same = std::count(in.begin(), in.end(), in[k]);
            const bool first =
                std::find(in.begin(), in.end(), in[k]) == in.begin() + static_cast<std::ptrdiff_t>(k);
            if (first && counts(in[k]) && uses_[in[k]] == same) change[class_of(in[k])] -= 1;
        }
        return (alive_[0] >= limit_[0] && change[0] > 0) ||
               (masks_apart_ && alive_[1] >= limit_[1] && change[1] > 0);
    }
    bool counts(ValueId v) const { return list_.steps()[v].op != StepOp::constant && issued(v); }
    bool issued(ValueId v) const { return ready_[v] != 0 && ready_[v] != not_yet; }

    void issue(ValueId v) {
        ++alive_[class_of(v)];
        for (const ValueId in : list_.operands_of(list_.steps()[v]))
            if (--uses_[in] == 0 && counts(in)) --alive_[class_of(in)];
        ready_[v] = cycle_ + latency_of(list_.steps()[v].op);
    }

    const StepList& list_;
    const std::vector<ValueId>& steps_;
    std::array<std::uint32_t, 2> limit_, alive_{};
    bool masks_apart_;
    std::vector<Waiting> waiting_;
    std::size_t next_ = 0;
    std::uint32_t cycle_ = 1;
    std::vector<std::int32_t> uses_;    ///< readers to come
    std::vector<std::uint32_t> ready_;  ///< cycle; 0: always there
};

}  // namespace

std::vector<ValueId> interleaved(const StepList& list, const std::vector<ValueId>& steps,
                                 std::uint32_t vectors, std::uint32_t masks) {
    return Scheduler(list, steps, vectors, masks).run();
}

}  // namespace frep::native
