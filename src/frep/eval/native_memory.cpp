// Implementation of native_memory.h. The pool gives out blocks of powers of two from chunks, and takes blocks
// back into a list for each size. It lives as long as the codes in it.
#include "frep/eval/native_memory.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace frep::native {

#if defined(__linux__)

class CodePool {
  public:
    static constexpr std::size_t chunk_size = std::size_t{1} << 20, largest_block = std::size_t{1} << 16;

    ~CodePool() {
        for (const Chunk& chunk : chunks_) {
            munmap(chunk.writable, chunk_size);
            munmap(chunk.executable, chunk_size);
        }
    }

    /// The executable address of a copy of `bytes`; null where the system refuses.
    std::uint8_t* put(std::span<const std::uint8_t> bytes) {
        const std::lock_guard lock(mutex_);
        const std::size_t kind = kind_of(bytes.size());
        auto& list = free_[kind];
        if (list.empty()) {
            const std::size_t block = smallest_block << kind;
            if (chunks_.empty() || used_ + block > chunk_size) {
                if (!add_chunk()) return nullptr;
            }
            list.push_back(
                {static_cast<std::uint32_t>(chunks_.size() - 1), static_cast<std::uint32_t>(used_)});
            used_ += block;
        }
        const Block block = list.back();
        list.pop_back();
        std::memcpy(chunks_[block.chunk].writable + block.offset, bytes.data(), bytes.size());
        return chunks_[block.chunk].executable + block.offset;
    }
    /// Takes back what put() gave for `size` bytes.
    void take_back(const std::uint8_t* at, std::size_t size) {
        const std::lock_guard lock(mutex_);
        for (std::uint32_t i = 0; i < chunks_.size(); ++i)
            if (at >= chunks_[i].executable && at < chunks_[i].executable + chunk_size)
                free_[kind_of(size)].push_back({i, static_cast<std::uint32_t>(at - chunks_[i].executable)});
    }

    /// The pool of the process; codes keep it alive past its static end.
    static std::shared_ptr<CodePool> shared() {
        static const auto pool = std::make_shared<CodePool>();
        return pool;
    }

  private:
    static constexpr std::size_t smallest_block = 256;
    struct Chunk {
        std::uint8_t *writable, *executable;
    };
    struct Block {
        std::uint32_t chunk, offset;
    };

    static std::size_t kind_of(std::size_t size) {
        return static_cast<std::size_t>(
            std::countr_zero(std::bit_ceil(std::max(size, smallest_block)) / smallest_block));
    }
    bool add_chunk() {
        const int file = memfd_create("frep code", MFD_CLOEXEC);
        if (file < 0) return false;
        void *writable = MAP_FAILED, *executable = MAP_FAILED;
        if (ftruncate(file, chunk_size) == 0) {
            writable = mmap(nullptr, chunk_size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
            executable = mmap(nullptr, chunk_size, PROT_READ | PROT_EXEC, MAP_SHARED, file, 0);
        }
        close(file);
        if (writable == MAP_FAILED || executable == MAP_FAILED) {
            if (writable != MAP_FAILED) munmap(writable, chunk_size);
            if (executable != MAP_FAILED) munmap(executable, chunk_size);
            return false;
        }
        chunks_.push_back({static_cast<std::uint8_t*>(writable), static_cast<std::uint8_t*>(executable)});
        used_ = 0;
        return true;
    }

    std::mutex mutex_;
    std::vector<Chunk> chunks_;
    std::size_t used_ = 0;                    ///< bytes of the last chunk
    std::array<std::vector<Block>, 9> free_;  ///< by size: 256 bytes to 64 KB
};

bool CodeMemory::map_alone(std::span<const std::uint8_t> bytes) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t size = (bytes.size() + page - 1) / page * page;
    void* const at = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) return false;
    std::memcpy(at, bytes.data(), bytes.size());
    if (mprotect(at, size, PROT_READ | PROT_EXEC) != 0) {
        munmap(at, size);
        return false;
    }
    data_ = static_cast<std::uint8_t*>(at);
    size_ = size;
    return true;
}

CodeMemory::CodeMemory(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return;
    if (bytes.size() <= CodePool::largest_block) {
        pool_ = CodePool::shared();
        data_ = pool_->put(bytes);
        size_ = bytes.size();
        if (data_) return;
        pool_.reset();
    }
    if (!map_alone(bytes)) size_ = 0;
}

CodeMemory::~CodeMemory() {
    if (!data_) return;
    if (pool_) {
        pool_->take_back(data_, size_);
    } else {
        munmap(data_, size_);
    }
}

#else

class CodePool {};
CodeMemory::CodeMemory(std::span<const std::uint8_t>) {}
CodeMemory::~CodeMemory() = default;

#endif

CodeMemory::CodeMemory(CodeMemory&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      pool_(std::move(other.pool_)) {}

CodeMemory& CodeMemory::operator=(CodeMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(pool_, other.pool_);
    return *this;
}

}  // namespace frep::native
