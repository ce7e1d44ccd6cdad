#include "tools/cli/print_trace.h"

#include <iostream>
#include <system_error>

#include "tools/cli/failure.h"

namespace lamina::tools {

PrintTrace::PrintTrace(const std::string& path, transport::Port& port, const transport::EngineOptions& engine,
                       double time_scale)
    : port_(port) {
  if (path.empty()) return;
  try {
    file_ = std::make_unique<transport::TraceFile>(path, transport::TraceHeader{port.name(), engine});
  } catch (const std::system_error& error) {
    throw Failure(ExitCode::kUsage, std::string("--trace: ") + error.what());
  }
  traced_ = std::make_unique<transport::TracingPort>(port, *file_, time_scale);
}

PrintTrace::~PrintTrace() {
  if (file_ && !file_->failure().empty()) std::cerr << "warning: " << file_->failure() << '\n';
}

}  // namespace lamina::tools
