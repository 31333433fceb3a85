// Evaluators for worker threads: each task borrows one and gives it back. Results do not depend on which.
// Tested through tests/unit/contour/contour_test.cpp and tests/unit/trace/plane_picture_test.cpp.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "frep/eval/sampled_field.h"

namespace frep {

class FieldPool {
  public:
    explicit FieldPool(const SampledField& field) : prototype_(field) {}

    /// A borrowed evaluator; returns to the pool at the end of the scope.
    class Lease {
      public:
        Lease(FieldPool& pool, std::unique_ptr<SampledField> field) : pool_(pool), field_(std::move(field)) {}
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;
        ~Lease() { pool_.put(std::move(field_)); }
        SampledField& operator*() const { return *field_; }
        SampledField* operator->() const { return field_.get(); }

      private:
        FieldPool& pool_;
        std::unique_ptr<SampledField> field_;
    };

    Lease borrow() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return {*this, prototype_.clone()};
        std::unique_ptr<SampledField> field = std::move(free_.back());
        free_.pop_back();
        return {*this, std::move(field)};
    }

  private:
    void put(std::unique_ptr<SampledField> field) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(field));
    }

    const SampledField& prototype_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<SampledField>> free_;
};

}  // namespace frep
