#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "tools/cli/json.h"
#include "tools/cli/print_source.h"
#include "tools/cli/progress_bar.h"
#include "transport/protocol/engine_options.h"
#include "transport/session/print_job.h"

namespace lamina::tools {

/// Shows a running print: a bar for people on stderr, and, if wanted, events for programs on stdout, one JSON
/// object a line.
class PrintDisplay {
 public:
  PrintDisplay(const PrintSource& source, ProgressBar& bar, const transport::Window& window, bool events);

  void update(const transport::JobProgress& progress);

  /// Something that the user should read.
  void say(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;

  void measure_rate(const transport::JobProgress& progress);
  std::string detail(const transport::JobProgress& progress) const;
  void emit(const Json& event) const;
  void emit_progress(const transport::JobProgress& progress) const;

  const PrintSource& source_;
  ProgressBar& bar_;
  transport::Window window_;
  bool events_;
  std::string phase_;
  std::int64_t layer_ = 0;
  Clock::time_point measured_{};
  Clock::time_point told_{};
  std::int64_t lines_then_ = 0;
  double lines_a_second_ = 0.0;
};

}  // namespace lamina::tools
