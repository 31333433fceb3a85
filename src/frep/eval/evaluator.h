// Evaluator: what every engine offers, in batches. Engines are made from a Field for one thread; clone()
// makes one for another thread. All engines of one numeric profile give the same bits
// (tests/unit/eval/conformance_test.cpp).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "frep/base/result.h"
#include "frep/field/field.h"
#include "frep/math/number.h"

namespace frep {

struct ClauseTape;

enum class Engine {
    reference,  ///< node by node in double: slow, obvious, the oracle
    vm,         ///< tapes over batches of lanes
    jit,        ///< the vm, and native code for values where it pays; the vm where there is none
};

struct EvaluatorOptions {
    Engine engine = Engine::jit;
    bool compile_at_once = false;        ///< jit: before the first point, whether it pays or not
    bool attributes = false;             ///< also compute the attributes s[1..k]
    std::int64_t max_steps = 1'000'000;  ///< loop steps at one point; more make the point undefined
    int registers = 0;                   ///< vm: registers to allocate; 0 = the engine's choice, at least 3
};

class Evaluator {
  public:
    virtual ~Evaluator() = default;
    virtual std::unique_ptr<Evaluator> clone() const = 0;

    /// n, the coordinates of a point.
    virtual int coordinates() const = 0;
    /// Values computed at a point: 1, or 1 + number of attributes.
    virtual int outputs() const = 0;
    /// Values at `count` points: coordinates[i][p] is coordinate i of point p; out[k][p] receives F (k = 0)
    /// and the attributes. `out` has outputs() columns, or one: then F alone is computed. NaN = undefined.
    virtual void values(std::span<const double* const> coordinates, std::size_t count,
                        std::span<double* const> out) = 0;
    /// F and its n partial derivatives: partials[i][p] = dF/dx_i. Total: finite where F is finite.
    virtual void gradients(std::span<const double* const> coordinates, std::size_t count, double* values,
                           std::span<double* const> partials) = 0;
    /// Enclosures of F over `count` boxes.
    virtual void intervals(std::span<const math::Interval* const> coordinates, std::size_t count,
                           math::Interval* out) = 0;
    /// The tape of F in single assignment, to be pruned for parts of space; null where there is none (an
    /// engine without tapes, a field that needs a region).
    virtual const ClauseTape* clauses() const { return nullptr; }
};

/// An evaluator of `field`. Errors: over_limit when the tape would exceed the memory limit.
Result<std::unique_ptr<Evaluator>> make_evaluator(const Field& field, const EvaluatorOptions& options = {});

/// Engine names for `--engine`, in the order of `frep info --engines`: those that this machine has, the
/// default last.
struct EngineInfo {
    Engine engine;
    std::string_view name;
    std::string_view doc;
};
std::span<const EngineInfo> engines();

/// The node where an undefined value at this point begins: one whose value is NaN while those of its
/// arguments are not. `root` is the field's value or an attribute; nothing when it is defined there. The
/// node's origin is the place in the model's text.
struct UndefinedCause {
    NodeId node = 0;
    Span origin;
};
std::vector<UndefinedCause> find_undefined(const Field& field, NodeId root, std::span<const double> point,
                                           std::int64_t max_steps = 1'000'000);

}  // namespace frep
