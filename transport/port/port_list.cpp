#include "transport/port/port_list.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "transport/port/port_obstacles.h"
#include "transport/port/usb_chip.h"

namespace lamina::transport {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (fs::directory_iterator file(folder, ignored), end; file != end; file.increment(ignored))
    files.push_back(file->path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The first line of a file in sysfs; empty without one.
std::string attribute(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

std::optional<int> usb_id(const fs::path& file) {
  const std::string text = attribute(file);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<UsbIdentity> usb_identity(const fs::path& usb_device) {
  const std::optional<int> vendor = usb_id(usb_device / "idVendor");
  const std::optional<int> product = usb_id(usb_device / "idProduct");
  if (!vendor || !product) return std::nullopt;
  return UsbIdentity{*vendor, *product, attribute(usb_device / "manufacturer"),
                     attribute(usb_device / "product"), attribute(usb_device / "serial")};
}

/// The USB device that a device of sysfs is a part of; empty where it is of none.
fs::path usb_device_of(fs::path device, const fs::path& sys) {
  std::error_code ignored;
  const fs::path root = fs::canonical(sys, ignored);
  for (; device != root && device.has_relative_path(); device = device.parent_path()) {
    if (fs::exists(device / "idVendor", ignored)) return device;
  }
  return {};
}

std::string describe(const UsbIdentity& usb) {
  const UsbChip* const chip = find_usb_chip(usb.vendor, usb.product);
  const std::string name = !usb.product_name.empty()   ? usb.product_name
                           : !usb.manufacturer.empty() ? usb.manufacturer
                                                       : "USB device";
  const bool adds = chip != nullptr && name.find(chip->name) == std::string::npos;
  return adds ? fmt::format("{} ({})", name, chip->name) : name;
}

/// A built-in port that the driver provides for, and the machine does not have, is of type 0.
bool is_placeholder(const fs::path& tty) {
  return attribute(tty / "type") == "0";
}

class PortList {
 public:
  explicit PortList(const SystemFolders& folders) : folders_(folders), programs_(folders.proc) {}

  std::vector<PortEntry> make() {
    for (const fs::path& tty : files_in(folders_.sys / "class/tty")) add_port(tty);
    for (const fs::path& device : files_in(folders_.sys / "bus/usb/devices")) add_without_port(device);
    return std::move(entries_);
  }

 private:
  void add_port(const fs::path& tty) {
    std::error_code ignored;
    const fs::path device = fs::canonical(tty / "device", ignored);
    // A console or a pseudo-terminal has no device behind it.
    if (device.empty() || is_placeholder(tty)) return;
    PortEntry entry;
    const std::string name = tty.filename().string();
    entry.path = "/dev/" + name;
    entry.driver = fs::read_symlink(device / "driver", ignored).filename().string();
    if (const fs::path usb_device = usb_device_of(device, folders_.sys); !usb_device.empty()) {
      entry.usb = usb_identity(usb_device);
      usb_devices_with_port_.insert(usb_device);
    }
    entry.description = entry.usb ? describe(*entry.usb) : "built-in serial port";
    for (const char* const kind : {"by-id", "by-path"}) {
      for (const fs::path& link : files_in(folders_.dev / "serial" / kind)) {
        if (fs::read_symlink(link, ignored).filename() == name)
          entry.stable_paths.push_back(std::string("/dev/serial/") + kind + "/" + link.filename().string());
      }
    }
    entry.obstacles = port_obstacles(entry, attribute(tty / "dev"), folders_, programs_);
    entries_.push_back(std::move(entry));
  }

  void add_without_port(const fs::path& link) {
    std::error_code ignored;
    const fs::path device = fs::canonical(link, ignored);
    if (usb_devices_with_port_.count(device) > 0) return;
    const std::optional<UsbIdentity> usb = usb_identity(device);
    if (!usb || find_usb_chip(usb->vendor, usb->product) == nullptr) return;
    PortEntry entry;
    entry.usb = usb;
    entry.description = describe(*usb);
    entry.obstacles = {missing_port(*usb, folders_, programs_)};
    entries_.push_back(std::move(entry));
  }

  const SystemFolders& folders_;
  RunningPrograms programs_;
  std::vector<PortEntry> entries_;
  std::set<fs::path> usb_devices_with_port_;
};

}  // namespace

std::vector<PortEntry> list_ports(const SystemFolders& folders) {
  return PortList(folders).make();
}

}  // namespace lamina::transport
