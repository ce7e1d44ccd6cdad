#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace lamina::tools {

/// A process that is watched, and can be killed. It reads nothing, its standard output is dropped, its
/// standard error goes into a file. It is dead when this object is gone.
class HostProcess {
 public:
  /// Throws std::runtime_error where no process can be started.
  HostProcess(const std::vector<std::string>& command, const std::filesystem::path& messages);
  HostProcess(const HostProcess&) = delete;
  HostProcess& operator=(const HostProcess&) = delete;
  ~HostProcess() { kill(); }

  /// Its exit status (-1: a signal) if it ends within so many seconds.
  std::optional<int> wait(double seconds);

  /// SIGKILL.
  void kill();

  /// The most memory that it held at any time, bytes; once it has ended.
  long peak_memory() const { return peak_memory_; }

 private:
  pid_t process_ = -1;
  long peak_memory_ = 0;
};

}  // namespace lamina::tools
