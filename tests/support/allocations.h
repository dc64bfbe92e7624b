#pragma once

// Counts what a program of tests allocates, with new or malloc, in our code or in Eigen's. To be included by
// one file of it, and used where no sanitizer is, which brings an allocator of its own.
#include <cstddef>

namespace rex {

inline long allocationCount = 0;

/// How many allocations there have been.
inline long allocations() { return allocationCount; }

}  // namespace rex

#ifndef __SANITIZE_ADDRESS__
// In place of those of glibc, whose own names these are.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++rex::allocationCount;
  return __libc_malloc(size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++rex::allocationCount;
  return __libc_memalign(alignment, size);
}
}
#endif
