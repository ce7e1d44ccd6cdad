#include "transport/port/port.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "transport/port/pty_port.h"
#include "transport/port/serial_port.h"

namespace lamina::transport {

namespace {

std::string hint_for(PortProblem problem) {
  switch (problem) {
    case PortProblem::kNoSuchDevice:
      return "plug the printer in, switch it on, and look for it under /dev/serial/by-id";
    case PortProblem::kPermission:
      return "add yourself to the group dialout (sudo usermod -aG dialout $USER) and log in again";
    case PortProblem::kBusy:
      return "close the other program that uses it (fuser -v shows which)";
    case PortProblem::kUnplugged:
      return "check the cable and the printer's power; the heaters may still be on";
    case PortProblem::kNotATerminal:
      return "name a serial device such as /dev/ttyUSB0, or a pseudo-terminal";
    case PortProblem::kUnsupportedBaud:
      return "use a usual speed: 115200 or 250000";
    case PortProblem::kSystem:
      return "";
  }
  return "";
}

std::string message(const std::string& path, const std::string& detail, const std::string& hint) {
  return path + ": " + detail + (hint.empty() ? "" : "; " + hint);
}

PortProblem problem_for(int error) {
  switch (error) {
    case ENOENT:
      return PortProblem::kNoSuchDevice;
    case EACCES:
    case EPERM:
      return PortProblem::kPermission;
    case EBUSY:
    case EWOULDBLOCK:
      return PortProblem::kBusy;
    case EIO:
    case ENXIO:
    case ENODEV:
    case EPIPE:
      return PortProblem::kUnplugged;
    case ENOTTY:
    case EISDIR:
      return PortProblem::kNotATerminal;
    default:
      return PortProblem::kSystem;
  }
}

}  // namespace

PortError::PortError(PortProblem what_problem, std::string where, const std::string& detail)
    : std::runtime_error(message(where, detail, hint_for(what_problem))),
      problem(what_problem),
      path(std::move(where)),
      hint(hint_for(what_problem)) {}

PortError port_error_from_errno(int error, const std::string& path) {
  return {problem_for(error), path, std::generic_category().message(error)};
}

std::unique_ptr<Port> open_port(const std::string& path, const PortOptions& options) {
  std::error_code failed;
  const std::filesystem::path device = std::filesystem::canonical(path, failed);
  if (failed) throw port_error_from_errno(failed.value(), path);
  // libserialport knows a port by its entry here; a pseudo-terminal has none.
  if (std::filesystem::exists("/sys/class/tty" / device.filename(), failed)) {
    return std::make_unique<SerialPort>(device.string(), options.baud);
  }
  return std::make_unique<PtyPort>(device.string());
}

}  // namespace lamina::transport
