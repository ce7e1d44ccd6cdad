#include "tools/bench/measurement.h"

#include <cstdio>
#include <exception>

#include <fmt/format.h>

namespace lamina::tools {

int run_measurement(int (*measurement)(int, char**), int argc, char** argv) {
  try {
    return measurement(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}

}  // namespace lamina::tools
