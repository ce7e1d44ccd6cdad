#pragma once

#include <functional>
#include <vector>

namespace lamina::tools {

/// What a piece of work gave and what it cost.
struct ChildRun {
  std::vector<double> values;
  double peak_megabytes = 0.0;  ///< of resident memory, program and libraries included
  double cpu_seconds = 0.0;
};

/// Does the work in a process of its own, so that its peak memory is its alone: the caller should hold little
/// when it calls. Throws std::runtime_error when the process does not end well, with its last words on
/// stderr.
ChildRun run_in_child(const std::function<std::vector<double>()>& work);

}  // namespace lamina::tools
