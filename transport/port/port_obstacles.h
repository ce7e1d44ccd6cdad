#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "transport/port/port_list.h"

namespace lamina::transport {

/// The programs that are running, as far as they concern ports.
class RunningPrograms {
 public:
  explicit RunningPrograms(const std::filesystem::path& proc);

  bool is_running(const std::string& name) const;

  /// "name (pid 123)" of every program that has the device open.
  std::vector<std::string> holders(const std::string& device) const;

 private:
  struct Program {
    std::string name;
    std::string id;
    std::vector<std::string> open_files;
  };
  std::vector<Program> programs_;
};

/// What stands in the way of the port `entry`, whose path is set. `device_number` as in sysfs: "188:0".
std::vector<PortObstacle> port_obstacles(const PortEntry& entry, const std::string& device_number,
                                         const SystemFolders& folders, const RunningPrograms& programs);

/// Why a device with these ids has no port.
PortObstacle missing_port(const UsbIdentity& usb, const SystemFolders& folders,
                          const RunningPrograms& programs);

}  // namespace lamina::transport
