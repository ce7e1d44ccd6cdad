#include <iostream>
#include <memory>

#include <fmt/format.h>

#include "tools/cli/json.h"
#include "tools/cli/verbs.h"
#include "transport/port/port_list.h"

namespace lamina::tools {
namespace {

using transport::ObstacleKind;

struct PortsArguments {
  bool json = false;
};

const char* kind_name(ObstacleKind kind) {
  switch (kind) {
    case ObstacleKind::kPermission:
      return "permission";
    case ObstacleKind::kBusy:
      return "busy";
    case ObstacleKind::kModemManager:
      return "modem_manager";
    case ObstacleKind::kBrltty:
      return "brltty";
    case ObstacleKind::kNoDriver:
      return "no_driver";
  }
  return "";
}

std::string hex(int id) {
  return fmt::format("{:04x}", id);
}

Json to_json(const transport::PortEntry& port) {
  Json json{{"path", port.path.empty() ? Json(nullptr) : Json(port.path)},
            {"stable_paths", port.stable_paths},
            {"description", port.description},
            {"driver", port.driver}};
  if (port.usb) {
    json["usb"] = {{"vendor_id", hex(port.usb->vendor)},
                   {"product_id", hex(port.usb->product)},
                   {"manufacturer", port.usb->manufacturer},
                   {"product", port.usb->product_name},
                   {"serial", port.usb->serial}};
  }
  json["problems"] = Json::array();
  for (const transport::PortObstacle& obstacle : port.obstacles) {
    json["problems"].push_back(
        {{"kind", kind_name(obstacle.kind)}, {"detail", obstacle.detail}, {"remedy", obstacle.remedy}});
  }
  return json;
}

std::string port_text(const transport::PortEntry& port) {
  std::string text = fmt::format("{:14} {}", port.path.empty() ? "(no port)" : port.path, port.description);
  if (port.usb) text += fmt::format("  [{}:{}]", hex(port.usb->vendor), hex(port.usb->product));
  text += '\n';
  for (const std::string& path : port.stable_paths) text += fmt::format("  also     {}\n", path);
  for (const transport::PortObstacle& obstacle : port.obstacles)
    text += fmt::format("  problem  {}\n  remedy   {}\n", obstacle.detail, obstacle.remedy);
  return text;
}

ExitCode run(const PortsArguments& arguments) {
  const std::vector<transport::PortEntry> ports = transport::list_ports();
  if (arguments.json) {
    Json json = Json::array();
    for (const transport::PortEntry& port : ports) json.push_back(to_json(port));
    std::cout << to_text(json) << '\n';
    return ExitCode::kOk;
  }
  for (const transport::PortEntry& port : ports) std::cout << port_text(port);
  if (ports.empty()) {
    std::cout << "no serial port: plug the printer in and switch it on; if it still does not show up, try "
                 "another cable (some only charge)\n";
  }
  return ExitCode::kOk;
}

}  // namespace

Verb ports_verb() {
  const auto arguments = std::make_shared<PortsArguments>();
  return {
      "ports", "List the serial ports, and what stands in the way of printing over them",
      "  lamina ports\n"
      "  lamina ports --json",
      [arguments](OptionSet& options) { options.flag("--json", arguments->json, "Print the list as JSON"); },
      [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
