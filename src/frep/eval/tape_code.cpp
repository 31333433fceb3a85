// Implementation of tape_code.h.
#include "frep/eval/tape_code.h"

#include <algorithm>
#include <cstdint>

namespace frep {

namespace {

/// Rows are shared only where there are enough of them to leave the first cache.
constexpr std::size_t few_clauses = 32;

bool are_equal(const Clause& a, const Clause& b) {
    return a.op == b.op && a.listed == b.listed && a.count == b.count && a.out == b.out && a.in == b.in;
}

bool are_equal(const ClauseTape& a, const ClauseTape& b) {
    return a.data == b.data && a.root == b.root && a.rows == b.rows && a.operands == b.operands &&
           std::equal(a.clauses.begin(), a.clauses.end(), b.clauses.begin(), b.clauses.end(),
                      [](const Clause& p, const Clause& q) { return are_equal(p, q); });
}

std::uint64_t hash_of(const ClauseTape& tape) {
    std::uint64_t h = tape.root;
    const auto add = [&h](std::uint64_t v) { h = (h ^ v) * 0x9e3779b97f4a7c15u; };
    for (const Clause& c : tape.clauses)
        add(static_cast<std::uint64_t>(c.op) ^ std::uint64_t{c.in[0]} << 8 ^ std::uint64_t{c.in[1]} << 28 ^
            std::uint64_t{c.in[2]} << 44);
    return h ^ h >> 32;
}

}  // namespace

const ClauseTape& TapeCode::packed() {
    if (tape_.clauses.size() <= few_clauses) return tape_;
    if (!packed_) {
        packed_ = tape_;
        pack_rows(*packed_);
    }
    return *packed_;
}

/// Counts points; compiles when as many have gone by as make it worth it, so that the cost of both together
/// is at most twice that of the better one.
bool TapeCode::compiles_for(std::size_t points) {
    if (is_decided_) return native_.has_value();
    points_ += points;
    if (!native_code_pays<double>(tape_, points_)) return false;
    is_decided_ = true;
    native_ = NativeCode<double>::compile(tape_);
    return native_.has_value();
}

void TapeCode::values(BatchVm<double>& vm, std::span<const double* const> coordinates, std::size_t count,
                      double* out) {
    if (compiles_for(count))
        native_->run(coordinates.data(), count, out);
    else
        vm.values(packed(), coordinates, count, out);
}

void TapeCode::gradients(BatchVm<double>& vm, std::span<const double* const> coordinates, std::size_t count,
                         double* values, std::span<double* const> partials) {
    vm.gradients(packed(), coordinates, count, values, partials);
}

std::shared_ptr<TapeCode> TapeCodes::code_for(const ClauseTape& tape) {
    if (tape.clauses.size() > most_clauses) return std::make_shared<TapeCode>(tape);
    std::shared_ptr<TapeCode>& kept = kept_[hash_of(tape) % kept_.size()];
    if (!kept || !are_equal(kept->tape(), tape)) kept = std::make_shared<TapeCode>(tape);
    return kept;
}

}  // namespace frep
