// One of the targets for libFuzzer: compile with -DLAMINA_FUZZ_TARGET=replies, for instance.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lamina::fuzz::LAMINA_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
