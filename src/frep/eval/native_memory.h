// Memory for machine code: a view that can be written and another, elsewhere, that can be run; no address can
// be both (W^X). Method: a pool of memory files (memfd), each mapped twice, so that small codes cost no
// system call; where the system has none, and for large codes, a mapping that is written first and then made
// executable. Tested by tests/unit/eval/native_code_test.cpp, which reads /proc/self/maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace frep::native {

class CodePool;

/// Memory that holds `bytes`, readable and executable; freed with the object. Empty where the system refuses.
class CodeMemory {
  public:
    CodeMemory() = default;
    explicit CodeMemory(std::span<const std::uint8_t> bytes);
    ~CodeMemory();
    CodeMemory(CodeMemory&& other) noexcept;
    CodeMemory& operator=(CodeMemory&& other) noexcept;

    const std::uint8_t* data() const { return data_; }
    std::size_t size() const { return size_; }

  private:
    bool map_alone(std::span<const std::uint8_t> bytes);

    std::uint8_t* data_ = nullptr;
    std::size_t size_ = 0;
    std::shared_ptr<CodePool> pool_;  ///< empty: a mapping of its own
};

}  // namespace frep::native
