#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace duolux {

/// Allocates memory that the operating system hands out filled with zeros, page by page when it is first
/// used: gigabytes of it take no time. For types whose zero is all bits 0.
template <typename T>
struct ZeroedAllocator {
    static_assert(std::is_trivially_copyable_v<T>);
    using value_type = T;

    ZeroedAllocator() = default;
    template <typename U>
    explicit ZeroedAllocator(const ZeroedAllocator<U>&) {}

    T* allocate(std::size_t count) {
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_alloc();
        void* const memory = std::calloc(count, sizeof(T));
        if (memory == nullptr) throw std::bad_alloc();
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) { std::free(memory); }

    /// Elements without a value keep the zeros of fresh memory.
    void construct(T*) {}
    template <typename... Arguments>
    void construct(T* at, Arguments&&... arguments) {
        ::new (at) T(std::forward<Arguments>(arguments)...);
    }

    bool operator==(const ZeroedAllocator&) const { return true; }
};

/// Fill it only by its constructors: elements that are resized away and added again keep their old values.
template <typename T>
using ZeroedVector = std::vector<T, ZeroedAllocator<T>>;

}  // namespace duolux
