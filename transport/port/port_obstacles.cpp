#include "transport/port/port_obstacles.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include "transport/port/usb_chip.h"

namespace lamina::transport {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNameBufferBytes = 16384;
constexpr const char* kInstallRules = "install lamina's udev rules, then plug the printer in again";

std::string group_name(gid_t group) {
  ::group entry{};
  ::group* found = nullptr;
  std::vector<char> buffer(kNameBufferBytes);
  ::getgrgid_r(group, &entry, buffer.data(), buffer.size(), &found);
  return found != nullptr ? found->gr_name : std::to_string(group);
}

/// The user is listed as a member, whatever this session knows of it.
bool is_listed_member(gid_t group) {
  ::passwd entry{};
  ::passwd* found = nullptr;
  std::vector<char> buffer(kNameBufferBytes);
  ::getpwuid_r(::getuid(), &entry, buffer.data(), buffer.size(), &found);
  if (found == nullptr) return false;
  std::array<gid_t, 256> groups{};
  int count = static_cast<int>(groups.size());
  if (::getgrouplist(found->pw_name, found->pw_gid, groups.data(), &count) < 0) return false;
  return std::find(groups.begin(), groups.begin() + count, group) != groups.begin() + count;
}

std::optional<PortObstacle> permission_obstacle(const fs::path& device, const SystemFolders& folders) {
  const bool may_open =
      folders.may_open ? folders.may_open(device) : ::access(device.c_str(), R_OK | W_OK) == 0;
  struct stat status {};
  if (may_open || ::stat(device.c_str(), &status) != 0) return std::nullopt;
  constexpr mode_t kGroupMayUse = S_IRGRP | S_IWGRP;
  PortObstacle obstacle{ObstacleKind::kPermission, "you may not open it", kInstallRules};
  if ((status.st_mode & kGroupMayUse) != kGroupMayUse) return obstacle;
  const std::string group = group_name(status.st_gid);
  obstacle.detail += "; members of the group " + group + " may";
  obstacle.remedy =
      is_listed_member(status.st_gid)
          ? "you are in the group " + group + ", and this session does not know yet: log out and in again"
          : "sudo usermod -aG " + group + " $USER, then log out and in again";
  return obstacle;
}

/// True if a udev rule has told ModemManager to stay away.
bool is_kept_from_modem_manager(const std::string& device_number, const SystemFolders& folders) {
  std::ifstream file(folders.run / "udev/data" / ("c" + device_number));
  for (std::string line; std::getline(file, line);) {
    if (line == "E:ID_MM_DEVICE_IGNORE=1" || line == "E:ID_MM_PORT_IGNORE=1") return true;
  }
  return false;
}

bool has_brltty_rules(const SystemFolders& folders) {
  for (const fs::path& folder : folders.udev_rules) {
    std::error_code ignored;
    for (fs::directory_iterator file(folder, ignored), end; file != end; file.increment(ignored)) {
      if (file->path().filename().string().find("brltty") != std::string::npos) return true;
    }
  }
  return false;
}

}  // namespace

RunningPrograms::RunningPrograms(const fs::path& proc) {
  std::error_code ignored;
  for (fs::directory_iterator entry(proc, ignored), end; entry != end; entry.increment(ignored)) {
    Program program;
    program.id = entry->path().filename().string();
    if (!std::all_of(program.id.begin(), program.id.end(),
                     [](unsigned char letter) { return std::isdigit(letter); }))
      continue;
    std::ifstream name(entry->path() / "comm");
    std::getline(name, program.name);
    std::error_code hidden;
    for (fs::directory_iterator file(entry->path() / "fd", hidden), last; file != last;
         file.increment(hidden)) {
      std::error_code gone;
      program.open_files.push_back(fs::read_symlink(file->path(), gone).string());
      if (hidden) break;
    }
    programs_.push_back(std::move(program));
  }
  std::sort(programs_.begin(), programs_.end(), [](const Program& a, const Program& b) {
    return std::pair(a.id.size(), a.id) < std::pair(b.id.size(), b.id);
  });
}

bool RunningPrograms::is_running(const std::string& name) const {
  return std::any_of(programs_.begin(), programs_.end(),
                     [&](const Program& program) { return program.name == name; });
}

std::vector<std::string> RunningPrograms::holders(const std::string& device) const {
  std::vector<std::string> names;
  for (const Program& program : programs_) {
    const auto& files = program.open_files;
    if (std::find(files.begin(), files.end(), device) != files.end())
      names.push_back(fmt::format("{} (pid {})", program.name, program.id));
  }
  return names;
}

std::vector<PortObstacle> port_obstacles(const PortEntry& entry, const std::string& device_number,
                                         const SystemFolders& folders, const RunningPrograms& programs) {
  std::vector<PortObstacle> obstacles;
  const fs::path device = folders.dev / fs::path(entry.path).filename();
  if (const auto permission = permission_obstacle(device, folders)) obstacles.push_back(*permission);
  if (const std::vector<std::string> holders = programs.holders(entry.path); !holders.empty()) {
    obstacles.push_back(
        {ObstacleKind::kBusy, fmt::format("in use by {}", fmt::join(holders, ", ")), "close that program"});
  }
  if (entry.usb && programs.is_running("ModemManager") &&
      !is_kept_from_modem_manager(device_number, folders)) {
    obstacles.push_back({ObstacleKind::kModemManager,
                         "ModemManager may take it for a modem for some seconds after it is plugged in",
                         kInstallRules});
  }
  return obstacles;
}

PortObstacle missing_port(const UsbIdentity& usb, const SystemFolders& folders,
                          const RunningPrograms& programs) {
  const UsbChip* const chip = find_usb_chip(usb.vendor, usb.product);
  if (chip != nullptr && chip->braille_displays &&
      (programs.is_running("brltty") || has_brltty_rules(folders))) {
    return {ObstacleKind::kBrltty, "brltty, the driver of braille displays, takes this adapter for one",
            "without a braille display: sudo apt remove brltty, then plug the printer in again"};
  }
  return {ObstacleKind::kNoDriver, "plugged in, but no driver has made a port of it",
          chip == nullptr ? "plug it in again"
                          : fmt::format("sudo modprobe {}, then plug it in again", chip->module)};
}

}  // namespace lamina::transport
