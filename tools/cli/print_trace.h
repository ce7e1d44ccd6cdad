#pragma once

#include <memory>
#include <string>

#include "transport/port/port.h"
#include "transport/protocol/engine_options.h"
#include "transport/trace/trace_file.h"
#include "transport/trace/tracing_port.h"

namespace lamina::tools {

/// The trace of a print, where one is wanted.
class PrintTrace {
 public:
  /// `path` empty: no trace. `time_scale` is the print's. Throws Failure (kUsage) where the file cannot be
  /// written.
  PrintTrace(const std::string& path, transport::Port& port, const transport::EngineOptions& engine,
             double time_scale);
  PrintTrace(const PrintTrace&) = delete;
  PrintTrace& operator=(const PrintTrace&) = delete;
  /// Says it if the trace is not complete.
  ~PrintTrace();

  /// What to print over.
  transport::Port& port() { return traced_ ? *traced_ : port_; }

 private:
  transport::Port& port_;
  std::unique_ptr<transport::TraceFile> file_;
  std::unique_ptr<transport::TracingPort> traced_;
};

}  // namespace lamina::tools
