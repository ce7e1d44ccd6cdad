#pragma once

#include <chrono>

#include "transport/port/port.h"
#include "transport/trace/trace_file.h"

namespace lamina::transport {

/// A port that does what another one does, and writes every byte with its time into a trace. Time begins with
/// this object.
class TracingPort : public Port {
 public:
  /// Both must live longer than this. `time_scale`: how many seconds pass in the trace in one second, as for
  /// the print that goes over the port.
  TracingPort(Port& port, TraceFile& trace, double time_scale = 1);

  std::size_t read(std::span<char> into) override;
  std::size_t write(std::string_view bytes) override;
  void wait(Duration at_most, bool until_writable) override;
  void discard() override;
  void close() override { port_.close(); }
  void set_baud(int baud) override { port_.set_baud(baud); }
  std::string name() const override { return port_.name(); }

 private:
  void record(TraceEvent event, std::string_view bytes);
  /// The error that is being handled, into the trace.
  void record_failure(const PortError& error) { record(TraceEvent::kFailed, error.what()); }

  Port& port_;
  TraceFile& trace_;
  double time_scale_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  TraceEntry entry_;  ///< kept for its memory
};

}  // namespace lamina::transport
