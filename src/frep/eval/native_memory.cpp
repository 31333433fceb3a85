// Implementation of native_memory.h.
#include "frep/eval/native_memory.h"

#include <cstring>
#include <utility>

#if defined(__unix__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace frep::native {

#if defined(__unix__)

CodeMemory::CodeMemory(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return;
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t size = (bytes.size() + page - 1) / page * page;
    void* const at = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) return;
    std::memcpy(at, bytes.data(), bytes.size());
    if (mprotect(at, size, PROT_READ | PROT_EXEC) != 0) {
        munmap(at, size);
        return;
    }
    data_ = static_cast<std::uint8_t*>(at);
    size_ = size;
}

CodeMemory::~CodeMemory() {
    if (data_) munmap(data_, size_);
}

#else

CodeMemory::CodeMemory(std::span<const std::uint8_t>) {}
CodeMemory::~CodeMemory() = default;

#endif

CodeMemory::CodeMemory(CodeMemory&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

CodeMemory& CodeMemory::operator=(CodeMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
}

}  // namespace frep::native
