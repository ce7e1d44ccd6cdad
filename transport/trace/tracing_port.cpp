#include "transport/trace/tracing_port.h"

namespace lamina::transport {

TracingPort::TracingPort(Port& port, TraceFile& trace, double time_scale)
    : port_(port), trace_(trace), time_scale_(time_scale) {}

std::size_t TracingPort::read(std::span<char> into) {
  try {
    const std::size_t count = port_.read(into);
    if (count > 0) record(TraceEvent::kReceived, {into.data(), count});
    return count;
  } catch (const PortError& error) {
    record_failure(error);
    throw;
  }
}

std::size_t TracingPort::write(std::string_view bytes) {
  try {
    const std::size_t count = port_.write(bytes);
    if (count > 0) record(TraceEvent::kSent, bytes.substr(0, count));
    return count;
  } catch (const PortError& error) {
    record_failure(error);
    throw;
  }
}

void TracingPort::wait(Duration at_most, bool until_writable) {
  try {
    port_.wait(at_most, until_writable);
  } catch (const PortError& error) {
    record_failure(error);
    throw;
  }
}

void TracingPort::discard() {
  port_.discard();
  record(TraceEvent::kDiscarded, {});
}

void TracingPort::record(TraceEvent event, std::string_view bytes) {
  const Duration real = std::chrono::steady_clock::now() - start_;
  entry_.at = Instant{time_scale_ == 1 ? real : from_seconds(to_seconds(real) * time_scale_)};
  entry_.event = event;
  entry_.bytes.assign(bytes);
  trace_.write(entry_);
}

}  // namespace lamina::transport
