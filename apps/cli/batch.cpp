// Implementation of batch.h: a slice of the batch for each thread.
#include "batch.h"

#include <cmath>
#include <exception>

#include "values.h"

namespace frep::cli {

namespace {

constexpr std::size_t smallest_slice = 512;  // points for which a thread is worth while

void append_interval(std::string& out, const math::Interval& f) {
    if (f.is_empty()) {
        out += "undefined\n";
        return;
    }
    append_number(out, f.lo);
    out += ' ';
    append_number(out, f.hi);
    out += f.maybe_undefined ? " maybe-undefined\n" : "\n";
}

}  // namespace

struct BatchEvaluator::Worker {
    std::unique_ptr<Evaluator> evaluator;
    BatchResult result;
    std::vector<std::vector<double>> outputs, partials;
    std::vector<double> values;
    std::vector<std::vector<math::Interval>> boxes;
    std::vector<math::Interval> enclosures;
    std::exception_ptr failure;

    void compute(Wanted wanted, const Columns& columns, std::size_t begin, std::size_t count);
    void compute_intervals(const Columns& columns, std::size_t begin, std::size_t count);
    void print(Wanted wanted, std::size_t begin, std::size_t count);
    void print_classes(const Classification& classification, std::size_t begin, std::size_t count);
};

void BatchEvaluator::Worker::compute(Wanted wanted, const Columns& columns, std::size_t begin,
                                     std::size_t count) {
    std::vector<const double*> inputs;
    for (const auto& column : columns) inputs.push_back(column.data() + begin);
    std::vector<double*> targets;
    outputs.resize(static_cast<std::size_t>(evaluator->outputs()));
    for (auto& output : outputs) {
        output.resize(count);
        targets.push_back(output.data());
    }
    evaluator->values(inputs, count, targets);
    if (wanted == Wanted::values) return;
    values.resize(count);
    partials.resize(columns.size());
    targets.clear();
    for (auto& partial : partials) {
        partial.resize(count);
        targets.push_back(partial.data());
    }
    evaluator->gradients(inputs, count, values.data(), targets);
}

void BatchEvaluator::Worker::compute_intervals(const Columns& columns, std::size_t begin, std::size_t count) {
    boxes.resize(columns.size() / 2);
    std::vector<const math::Interval*> inputs;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        boxes[i].resize(count);
        for (std::size_t p = 0; p < count; ++p)
            boxes[i][p] = {columns[2 * i][begin + p], columns[2 * i + 1][begin + p]};
        inputs.push_back(boxes[i].data());
    }
    enclosures.resize(count);
    evaluator->intervals(inputs, count, enclosures.data());
}

void BatchEvaluator::Worker::print(Wanted wanted, std::size_t begin, std::size_t count) {
    std::string& text = result.text;
    for (std::size_t p = 0; p < count; ++p) {
        bool is_undefined = false;
        for (std::size_t k = 0; k < outputs.size(); ++k) {
            const double value = outputs[k][p];
            if (k > 0) text += ' ';
            append_number(text, value);
            if (!std::isnan(value)) continue;
            is_undefined = true;
            if (!result.first) result.first = FirstUndefined{begin + p, k};
        }
        if (wanted == Wanted::gradients) {
            for (const auto& partial : partials) {
                text += ' ';
                append_number(text, std::isnan(outputs[0][p]) ? outputs[0][p] : partial[p]);
            }
        }
        text += '\n';
        result.undefined += is_undefined ? 1 : 0;
    }
}

void BatchEvaluator::Worker::print_classes(const Classification& classification, std::size_t begin,
                                           std::size_t count) {
    std::vector<double> gradient;
    for (std::size_t p = 0; p < count; ++p) {
        gradient.clear();
        for (std::size_t i = 0; i < partials.size(); ++i)
            if (classification.moving[i]) gradient.push_back(partials[i][p]);
        const double value = outputs[0][p];
        result.text += to_string(membership(value, gradient, classification.tolerance));
        result.text += '\n';
        if (!std::isnan(value)) continue;
        ++result.undefined;
        if (!result.first) result.first = FirstUndefined{begin + p, 0};
    }
}

BatchEvaluator::BatchEvaluator(std::unique_ptr<Evaluator> evaluator, Wanted wanted, int threads,
                               Classification classification)
    : wanted_(wanted), classification_(std::move(classification)) {
    for (int t = 1; t < threads; ++t) {
        workers_.push_back(std::make_unique<Worker>());
        workers_.back()->evaluator = evaluator->clone();
    }
    workers_.push_back(std::make_unique<Worker>());
    workers_.back()->evaluator = std::move(evaluator);
}

BatchEvaluator::~BatchEvaluator() = default;

void BatchEvaluator::run_slice(Worker& worker, const Columns& columns, std::size_t begin, std::size_t end) {
    worker.result = {};
    worker.failure = nullptr;
    try {
        if (wanted_ == Wanted::intervals) {
            worker.compute_intervals(columns, begin, end - begin);
            for (const math::Interval& f : worker.enclosures) append_interval(worker.result.text, f);
        } else {
            worker.compute(wanted_, columns, begin, end - begin);
            if (wanted_ == Wanted::classes)
                worker.print_classes(classification_, begin, end - begin);
            else
                worker.print(wanted_, begin, end - begin);
        }
    } catch (...) {
        worker.failure = std::current_exception();
    }
}

BatchResult BatchEvaluator::run(const Columns& columns, std::size_t count) {
    const std::size_t useful = (count + smallest_slice - 1) / smallest_slice;
    const std::size_t slices = std::max<std::size_t>(1, std::min(workers_.size(), useful));
    Job job;
    job.threads = static_cast<int>(slices);
    parallel_for(job, slices, [&](std::size_t i) {
        run_slice(*workers_[i], columns, i * count / slices, (i + 1) * count / slices);
    });
    BatchResult all;
    for (std::size_t s = 0; s < slices; ++s) {
        Worker& worker = *workers_[s];
        if (worker.failure) std::rethrow_exception(worker.failure);
        all.text += worker.result.text;
        all.undefined += worker.result.undefined;
        if (!all.first) all.first = worker.result.first;
    }
    return all;
}

}  // namespace frep::cli
