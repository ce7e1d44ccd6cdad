#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lamina::transport {

/// What a USB device says of itself.
struct UsbIdentity {
  int vendor = 0;
  int product = 0;
  std::string manufacturer;  ///< these three may be empty
  std::string product_name;
  std::string serial;
};

enum class ObstacleKind {
  kPermission,    ///< the user may not open it
  kBusy,          ///< another program has it open
  kModemManager,  ///< ModemManager may talk to it when it is plugged in
  kBrltty,        ///< brltty has taken the adapter for a braille display
  kNoDriver       ///< the device is there, and no driver has made a port of it
};

/// What stands in the way of printing over a port.
struct PortObstacle {
  ObstacleKind kind = ObstacleKind::kPermission;
  std::string detail;  ///< what is wrong, a phrase
  std::string remedy;  ///< what to do, a phrase
};

/// A serial port of this machine.
struct PortEntry {
  std::string path;                       ///< "/dev/ttyUSB0"; empty where a device has none
  std::vector<std::string> stable_paths;  ///< links that stay the same: by id, then by place
  std::string description;                ///< for people; never empty
  std::string driver;                     ///< of the kernel; may be empty
  std::optional<UsbIdentity> usb;
  std::vector<PortObstacle> obstacles;
};

/// Where the system tells of its devices. Tests have trees of their own.
struct SystemFolders {
  std::filesystem::path dev = "/dev";
  std::filesystem::path sys = "/sys";
  std::filesystem::path proc = "/proc";
  std::filesystem::path run = "/run";
  std::vector<std::filesystem::path> udev_rules{"/etc/udev/rules.d", "/run/udev/rules.d",
                                                "/usr/lib/udev/rules.d", "/lib/udev/rules.d"};
  /// Whether this user may read and write a device. Empty: ask the system.
  std::function<bool(const std::filesystem::path&)> may_open;
};

/// The serial ports that are there, sorted by path, and USB devices that look like a printer's and have no
/// port. Opens none of them: that might restart a board in the middle of its print. Which other program holds
/// a port shows only where this user may see that program. Never throws; what cannot be read is left out.
std::vector<PortEntry> list_ports(const SystemFolders& folders = {});

}  // namespace lamina::transport
