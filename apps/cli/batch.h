// Evaluates a batch of points or boxes on several threads and prints the values as text, in the order of the
// input whatever the number of threads. Tested by tests/cli.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frep/frep.h"

namespace frep::cli {

enum class Wanted {
    values,     ///< F and the attributes
    gradients,  ///< the same and the partial derivatives of F
    intervals,  ///< enclosures of F
    classes,    ///< in, on or out
};

/// What Wanted::classes needs to know.
struct Classification {
    double tolerance = 0;      ///< of "on", model units
    std::vector<bool> moving;  ///< by coordinate: false for frozen ones, along which no distance is measured
};

/// Where the first undefined value of a batch stands.
struct FirstUndefined {
    std::size_t point = 0;   ///< in the batch
    std::size_t output = 0;  ///< 0: F, k: s[k]
};

struct BatchResult {
    std::string text;           ///< a line for each point
    std::size_t undefined = 0;  ///< points with an undefined value
    std::optional<FirstUndefined> first;
};

/// Coordinates of a batch: columns[i][p] is coordinate i of the model at point p. For boxes there are two
/// columns for each coordinate, least and greatest value.
using Columns = std::vector<std::vector<double>>;

class BatchEvaluator {
  public:
    /// Takes the evaluator over and clones it for the other threads.
    BatchEvaluator(std::unique_ptr<Evaluator> evaluator, Wanted wanted, int threads,
                   Classification classification = {});
    ~BatchEvaluator();
    BatchResult run(const Columns& columns, std::size_t count);

  private:
    struct Worker;
    void run_slice(Worker& worker, const Columns& columns, std::size_t begin, std::size_t end);

    std::vector<std::unique_ptr<Worker>> workers_;
    Wanted wanted_;
    Classification classification_;
};

}  // namespace frep::cli
