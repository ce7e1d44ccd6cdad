#include "tests/engine/import/peak_memory.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#include <malloc.h>

// The sanitizers keep their own books of every block: with them nothing is counted, and the peak is 0.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LAMINA_COUNTS_MEMORY
#endif

namespace {

std::size_t in_use = 0;
std::size_t most_in_use = 0;

}  // namespace

#ifdef LAMINA_COUNTS_MEMORY
namespace {

void* counted(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  in_use += malloc_usable_size(block);
  most_in_use = std::max(most_in_use, in_use);
  return block;
}

void release(void* block) {
  in_use -= malloc_usable_size(block);
  std::free(block);
}

}  // namespace

// Replacing these counts what the whole program takes from the heap.
void* operator new(std::size_t size) {
  return counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
void operator delete(void* block) noexcept {
  release(block);
}
void operator delete(void* block, std::size_t) noexcept {
  release(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  release(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  release(block);
}
#endif

namespace lamina::tests {

std::size_t start_peak_memory() {
  most_in_use = in_use;
  return in_use;
}

std::size_t peak_memory() {
  return most_in_use;
}

}  // namespace lamina::tests
