// Implementation of jit_evaluator.h.
#include "frep/eval/jit_evaluator.h"

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <utility>

#include "frep/eval/clause_tape.h"
#include "frep/eval/native_code.h"
#include "frep/eval/vm_evaluator.h"

namespace frep {
namespace {

/// Longer tapes are interpreted: their code would not stay in the caches, and needs much memory to make.
constexpr std::size_t most_clauses = std::size_t{1} << 17;

/// Points from which on compiling pays; nothing where it never does.
std::optional<std::size_t> points_that_pay(const ClauseTape& tape) {
    constexpr std::size_t many = std::size_t{1} << 30;
    for (std::size_t points = 256; points <= many; points *= 2)
        if (native_code_pays<double>(tape, points)) return points;
    return std::nullopt;
}

/// What clones share: the count of points, and the code once it is made.
class SharedCode {
  public:
    SharedCode(ClauseTape tape, std::size_t threshold) : tape_(std::move(tape)), threshold_(threshold) {}

    /// The code to run `count` points by; null: interpret them. A thread does not wait for another one that
    /// compiles.
    const NativeCode<double>* for_points(std::size_t count) {
        if (const NativeCode<double>* ready = ready_.load(std::memory_order_acquire)) return ready;
        const std::size_t before = points_.fetch_add(count, std::memory_order_relaxed);
        if (before + count < threshold_ || failed_.load(std::memory_order_relaxed)) return nullptr;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock()) return nullptr;
        if (!code_) code_ = NativeCode<double>::compile(tape_);
        if (!code_) {
            failed_.store(true, std::memory_order_relaxed);
            return nullptr;
        }
        ready_.store(&*code_, std::memory_order_release);
        return &*code_;
    }

  private:
    const ClauseTape tape_;
    const std::size_t threshold_;
    std::atomic<std::size_t> points_ = 0;
    std::atomic<const NativeCode<double>*> ready_ = nullptr;
    std::atomic<bool> failed_ = false;
    std::mutex mutex_;
    std::optional<NativeCode<double>> code_;  ///< written once, under the mutex
};

class Jit final : public Evaluator {
  public:
    Jit(std::unique_ptr<Evaluator> vm, std::shared_ptr<SharedCode> shared)
        : vm_(std::move(vm)), shared_(std::move(shared)) {}

    std::unique_ptr<Evaluator> clone() const override { return std::make_unique<Jit>(vm_->clone(), shared_); }
    int coordinates() const override { return vm_->coordinates(); }
    int outputs() const override { return vm_->outputs(); }
    const ClauseTape* clauses() const override { return vm_->clauses(); }

    void values(std::span<const double* const> coordinates, std::size_t count,
                std::span<double* const> out) override {
        const NativeCode<double>* const code = out.size() == 1 ? shared_->for_points(count) : nullptr;
        if (!code) return vm_->values(coordinates, count, out);
        code->run(coordinates.data(), count, out[0]);
    }
    void gradients(std::span<const double* const> coordinates, std::size_t count, double* values,
                   std::span<double* const> partials) override {
        vm_->gradients(coordinates, count, values, partials);
    }
    void intervals(std::span<const math::Interval* const> coordinates, std::size_t count,
                   math::Interval* out) override {
        vm_->intervals(coordinates, count, out);
    }

  private:
    std::unique_ptr<Evaluator> vm_;
    std::shared_ptr<SharedCode> shared_;
};

}  // namespace

bool has_jit() { return NativeCode<double>::is_available(); }

Result<std::unique_ptr<Evaluator>> make_jit(const Field& field, const EvaluatorOptions& options) {
    auto vm = make_vm(field, options);
    if (!vm || !has_jit()) return vm;
    const ClauseTape* const tape = (*vm)->clauses();
    if (!tape || tape->clauses.empty() || tape->clauses.size() > most_clauses) return vm;
    const auto threshold = options.compile_at_once ? std::optional<std::size_t>(0) : points_that_pay(*tape);
    if (!threshold) return vm;
    auto shared = std::make_shared<SharedCode>(*tape, *threshold);
    return std::unique_ptr<Evaluator>(std::make_unique<Jit>(std::move(*vm), std::move(shared)));
}

}  // namespace frep
