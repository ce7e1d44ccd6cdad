#pragma once

#include <string>

#include "transport/trace/trace.h"

namespace lamina::transport {

/// A trace on its way to disk. Every entry is handed to the system at once, so that it is kept when this
/// program is killed. A disk that fails must not end a print: the file then ends there, and `failure` tells.
class TraceFile {
 public:
  /// Begins the file anew. Throws std::system_error where it cannot be written.
  TraceFile(const std::string& path, const TraceHeader& header);
  TraceFile(const TraceFile&) = delete;
  TraceFile& operator=(const TraceFile&) = delete;
  ~TraceFile();

  void write(const TraceEntry& entry);

  /// Why the file is not complete; empty as long as it is.
  const std::string& failure() const { return failure_; }

 private:
  void write_text();

  std::string path_;
  int descriptor_ = -1;
  std::string text_;  ///< kept for its memory
  std::string failure_;
};

/// Reads a trace from a file. Throws TraceError, std::system_error.
Trace read_trace(const std::string& path);

}  // namespace lamina::transport
