// Arrays that lie in scratch files where they are large.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/scratch_memory.h"

namespace oro {

// For std::vector: an array of least_bytes and more lies in the scratch files that the allocator holds on to;
// a smaller one, and any where it holds none, in ordinary memory. A copy of a vector lies where the original
// does. From any thread.
template <class T>
class ScratchAllocator {
  public:
    using value_type = T;
    using propagate_on_container_copy_assignment = std::true_type;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;
    static constexpr std::size_t least_bytes = 3'000'000;  // the corners of 250,000 triangles

    ScratchAllocator() = default;
    ScratchAllocator(std::shared_ptr<ScratchMemory> scratch) : scratch_(std::move(scratch)) {}
    template <class Other>
    ScratchAllocator(const ScratchAllocator<Other>& other) : scratch_(other.scratch()) {}

    [[nodiscard]] T* allocate(std::size_t count) {
        if (!is_in_files(count)) return std::allocator<T>().allocate(count);
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
        return static_cast<T*>(scratch_->allocate(count * sizeof(T), alignof(T)));
    }
    void deallocate(T* array, std::size_t count) {
        if (is_in_files(count))
            scratch_->deallocate(array, count * sizeof(T), alignof(T));
        else
            std::allocator<T>().deallocate(array, count);
    }
    [[nodiscard]] std::shared_ptr<ScratchMemory> scratch() const { return scratch_; }
    template <class Other>
    bool operator==(const ScratchAllocator<Other>& other) const {
        return scratch_ == other.scratch();
    }

  private:
    [[nodiscard]] bool is_in_files(std::size_t count) const {
        return scratch_ != nullptr && count >= least_bytes / sizeof(T);
    }
    std::shared_ptr<ScratchMemory> scratch_;
};

template <class T>
using ScratchVector = std::vector<T, ScratchAllocator<T>>;

// For loops that go once through arrays in such files, `done` times so far: now and then no page of them is
// in memory until it is asked for again. scratch: or null.
inline void drop_pages_after(ScratchMemory* scratch, std::size_t done) {
    constexpr std::size_t many = std::size_t{1} << 18U;
    if (scratch != nullptr && done % many == 0) scratch->drop_pages();
}

}  // namespace oro
