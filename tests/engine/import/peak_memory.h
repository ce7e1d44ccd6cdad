#pragma once

#include <cstddef>

namespace lamina::tests {

/// Starts to watch the heap of this program; the bytes in use now. Not for several threads.
std::size_t start_peak_memory();

/// The most bytes that were in use since then.
std::size_t peak_memory();

}  // namespace lamina::tests
