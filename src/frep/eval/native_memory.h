// Memory for machine code: written first, then made executable, never both at a time (W^X). Method: own
// mappings, mmap and mprotect. Tested by tests/unit/eval/native_code_test.cpp, which reads /proc/self/maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace frep::native {

/// A mapping that holds `bytes`, readable and executable; freed with the object. Empty where the system
/// refuses.
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
    std::uint8_t* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace frep::native
