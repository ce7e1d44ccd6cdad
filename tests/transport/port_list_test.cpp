#include "transport/port/port_list.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <tuple>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "transport/port/usb_chip.h"

namespace {

using namespace lamina::transport;
namespace fs = std::filesystem;

/// A machine made of files, with nothing plugged in.
class PretendMachine {
 public:
  PretendMachine() : root_(fs::temp_directory_path() / ("lamina-machine-" + std::to_string(::getpid()))) {
    fs::remove_all(root_);
    folders.dev = root_ / "dev";
    folders.sys = root_ / "sys";
    folders.proc = root_ / "proc";
    folders.run = root_ / "run";
    folders.udev_rules = {root_ / "rules"};
    folders.may_open = [](const fs::path&) { return true; };
    for (const fs::path& folder : {folders.dev, folders.sys, folders.proc, folders.run, root_ / "rules"})
      fs::create_directories(folder);
    // What every machine has: a console and a pseudo-terminal multiplexer.
    for (const char* const name : {"tty0", "ptmx"}) {
      put("sys/devices/virtual/tty/" + std::string(name) + "/dev", "4:0");
      link("sys/class/tty/" + std::string(name), "../../devices/virtual/tty/" + std::string(name));
    }
  }
  PretendMachine(const PretendMachine&) = delete;
  PretendMachine& operator=(const PretendMachine&) = delete;
  ~PretendMachine() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }

  void put(const std::string& path, const std::string& text) const {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text << '\n';
  }

  void link(const std::string& path, const std::string& target) const {
    fs::create_directories((root_ / path).parent_path());
    fs::create_symlink(target, root_ / path);
  }

  /// A USB device at bus 1, `place` "2.1"; returns its folder.
  std::string plug_in(const std::string& place, const std::string& vendor, const std::string& product,
                      const std::string& name) const {
    const std::string device = "sys/devices/pci0/usb1/1-" + place;
    put(device + "/idVendor", vendor);
    put(device + "/idProduct", product);
    if (!name.empty()) put(device + "/product", name);
    link("sys/bus/usb/devices/1-" + place, "../../../devices/pci0/usb1/1-" + place);
    return device;
  }

  /// The port that its driver makes of it.
  void attach(const std::string& device, const std::string& tty, const std::string& driver) const {
    const std::string interface = device + "/1:1.0/" + tty;
    put(interface + "/tty/" + tty + "/dev", "188:7");
    link(interface + "/tty/" + tty + "/device", "../..");
    put("sys/bus/drivers/" + driver + "/bind", "");
    link(interface + "/driver", (root_ / "sys/bus/drivers" / driver).string());
    link("sys/class/tty/" + tty, "../../" + interface.substr(4) + "/tty/" + tty);
    put("dev/" + tty, "");
  }

  void run(const std::string& id, const std::string& name, const std::string& open_file = "") const {
    put("proc/" + id + "/comm", name);
    if (!open_file.empty()) link("proc/" + id + "/fd/3", open_file);
  }

  SystemFolders folders;

 private:
  fs::path root_;
};

PretendMachine& with_ender(PretendMachine& machine) {
  machine.attach(machine.plug_in("2.1", "1a86", "7523", "USB2.0-Serial"), "ttyUSB0", "ch341-uart");
  machine.link("dev/serial/by-id/usb-1a86_USB2.0-Serial-if00-port0", "../../ttyUSB0");
  machine.link("dev/serial/by-path/pci-0:2.1:1.0-port0", "../../ttyUSB0");
  machine.link("dev/serial/by-id/usb-other", "../../ttyUSB01");
  return machine;
}

PortObstacle only_obstacle(const PretendMachine& machine) {
  const std::vector<PortEntry> ports = list_ports(machine.folders);
  REQUIRE(ports.size() == 1);
  REQUIRE(ports[0].obstacles.size() == 1);
  return ports[0].obstacles[0];
}

}  // namespace

TEST_CASE("ports: a machine without any has none") {
  const PretendMachine machine;
  CHECK(list_ports(machine.folders).empty());
  SystemFolders nothing;
  nothing.sys = nothing.dev = nothing.proc = nothing.run = "/no-such-folder";
  CHECK(list_ports(nothing).empty());
}

TEST_CASE("ports: this machine's are listed without a fuss") {
  CHECK_NOTHROW(list_ports());
}

TEST_CASE("ports: an adapter is told with names, ids and stable paths") {
  PretendMachine machine;
  const std::vector<PortEntry> ports = list_ports(with_ender(machine).folders);
  REQUIRE(ports.size() == 1);
  CHECK(ports[0].path == "/dev/ttyUSB0");
  CHECK(ports[0].description == "USB2.0-Serial (CH340)");
  CHECK(ports[0].driver == "ch341-uart");
  REQUIRE(ports[0].usb);
  CHECK(ports[0].usb->vendor == 0x1a86);
  CHECK(ports[0].usb->product == 0x7523);
  CHECK(ports[0].stable_paths ==
        std::vector<std::string>{"/dev/serial/by-id/usb-1a86_USB2.0-Serial-if00-port0",
                                 "/dev/serial/by-path/pci-0:2.1:1.0-port0"});
  CHECK(ports[0].obstacles.empty());
}

TEST_CASE("ports: several, built-in ones among them, in order") {
  PretendMachine machine;
  with_ender(machine);
  machine.attach(machine.plug_in("3", "2c99", "0002", "Original Prusa i3 MK3"), "ttyACM0", "cdc_acm");
  for (const auto& [name, type] : {std::pair("ttyS0", "4"), std::pair("ttyS1", "0")}) {
    const std::string tty = std::string("sys/devices/platform/serial8250/tty/") + name;
    machine.put(tty + "/type", type);
    machine.link(tty + "/device", "../..");
    machine.link(std::string("sys/class/tty/") + name,
                 "../../devices/platform/serial8250/tty/" + std::string(name));
  }
  std::vector<std::string> paths;
  for (const PortEntry& port : list_ports(machine.folders)) paths.push_back(port.path);
  // ttyS1 is a placeholder of the driver's.
  CHECK(paths == std::vector<std::string>{"/dev/ttyACM0", "/dev/ttyS0", "/dev/ttyUSB0"});
  // A keyboard is no printer.
  machine.plug_in("4", "046d", "c31c", "Keyboard");
  CHECK(list_ports(machine.folders).size() == 3);
}

TEST_CASE("ports: what the user may not open is said, with the group that may") {
  PretendMachine machine;
  with_ender(machine).folders.may_open = [](const fs::path& device) {
    return device.filename() != "ttyUSB0";
  };
  fs::permissions(machine.folders.dev / "ttyUSB0", fs::perms(0660));
  // Debian's group of serial devices, where this machine has it and the test may give files to it.
  const bool dialout = ::chown((machine.folders.dev / "ttyUSB0").c_str(), static_cast<uid_t>(-1), 20) == 0;
  const PortObstacle obstacle = only_obstacle(machine);
  CHECK(obstacle.kind == ObstacleKind::kPermission);
  CHECK(obstacle.detail.find("the group ") != std::string::npos);
  if (dialout) CHECK(obstacle.remedy == "sudo usermod -aG dialout $USER, then log out and in again");

  fs::permissions(machine.folders.dev / "ttyUSB0", fs::perms(0600));
  CHECK(only_obstacle(machine).remedy.find("udev") != std::string::npos);
}

TEST_CASE("ports: who has a port open is said") {
  PretendMachine machine;
  with_ender(machine);
  machine.run("12", "bash", "/dev/pts/1");
  machine.run("345", "pronterface", "/dev/ttyUSB0");
  machine.run("46", "octoprint", "/dev/ttyUSB0");
  machine.run("self", "me", "/dev/ttyUSB0");
  const PortObstacle obstacle = only_obstacle(machine);
  CHECK(obstacle.kind == ObstacleKind::kBusy);
  CHECK(obstacle.detail == "in use by octoprint (pid 46), pronterface (pid 345)");
}

TEST_CASE("ports: ModemManager is a danger until a rule keeps it away") {
  PretendMachine machine;
  with_ender(machine);
  machine.run("1", "ModemManager");
  CHECK(only_obstacle(machine).kind == ObstacleKind::kModemManager);
  machine.put("run/udev/data/c188:7", "S:serial/by-id/x\nE:ID_MM_DEVICE_IGNORE=1");
  CHECK(list_ports(machine.folders)[0].obstacles.empty());
}

TEST_CASE("ports: an adapter that brltty has taken, and one without a driver") {
  PretendMachine machine;
  machine.plug_in("2.1", "1a86", "7523", "USB2.0-Serial");
  const PortObstacle no_driver = only_obstacle(machine);
  CHECK(no_driver.kind == ObstacleKind::kNoDriver);
  CHECK(no_driver.remedy.find("modprobe ch341") != std::string::npos);
  CHECK(list_ports(machine.folders)[0].path.empty());

  machine.put("rules/85-brltty.rules", "");
  CHECK(only_obstacle(machine).kind == ObstacleKind::kBrltty);
  fs::remove(machine.folders.udev_rules[0] / "85-brltty.rules");
  machine.run("9", "brltty");
  CHECK(only_obstacle(machine).remedy.find("apt remove brltty") != std::string::npos);
}

TEST_CASE("ports: the udev rules name the same devices as the program, in udev's grammar") {
  std::ifstream file(std::string(LAMINA_SOURCE_DIR) + "/tools/udev/70-lamina-printers.rules");
  REQUIRE(file);
  const std::regex grammar(
      R"re(([A-Z_]+(\{[A-Za-z_]+\})?(==|!=|=|\+=)"[^"]*")(, [A-Z_]+(\{[A-Za-z_]+\})?(==|!=|=|\+=)"[^"]*")*)re");
  const std::regex device(
      R"re(ATTRS\{idVendor\}=="([0-9a-f]{4})"(, ATTRS\{idProduct\}=="([0-9a-f]{4})")?, .*)re");
  std::set<std::pair<std::string, std::string>> in_rules;
  std::string all;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    INFO(line);
    CHECK(std::regex_match(line, grammar));
    std::smatch ids;
    if (std::regex_match(line, ids, device)) in_rules.emplace(ids[1], ids[3]);
    all += line + '\n';
  }
  std::set<std::pair<std::string, std::string>> in_program;
  for (const UsbChip& chip : usb_chips()) {
    in_program.emplace(fmt::format("{:04x}", chip.vendor),
                       chip.product == kAnyProduct ? "" : fmt::format("{:04x}", chip.product));
  }
  CHECK(in_rules == in_program);
  // Every jump has its target.
  const std::regex jump("GOTO=\"([a-z_]+)\"");
  for (std::sregex_iterator found(all.begin(), all.end(), jump), end; found != end; ++found)
    CHECK(all.find("LABEL=\"" + (*found)[1].str() + "\"") != std::string::npos);
  CHECK(all.find("TAG+=\"uaccess\"") != std::string::npos);
  CHECK(all.find("ENV{ID_MM_DEVICE_IGNORE}=\"1\"") != std::string::npos);
}
