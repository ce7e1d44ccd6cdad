#include "transport/port/port.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "transport/port/baud_search.h"
#include "transport/port/pty_port.h"
#include "transport/port/serial_port.h"
#include "transport/port/tcp_address.h"
#include "transport/port/tcp_port.h"

namespace lamina::transport {

namespace {

std::string hint_for(PortProblem problem) {
  switch (problem) {
    case PortProblem::kNoSuchDevice:
      return "plug the printer in and switch it on; 'lamina ports' lists what is there";
    case PortProblem::kPermission:
      return "add yourself to the group dialout (sudo usermod -aG dialout $USER) and log in again";
    case PortProblem::kBusy:
      return "close the other program that uses it ('lamina ports' shows which)";
    case PortProblem::kUnplugged:
      return "check cable, network and the printer's power; the heaters may still be on";
    case PortProblem::kNotATerminal:
      return "name a serial device such as /dev/ttyUSB0, a pseudo-terminal, or tcp://HOST:PORT";
    case PortProblem::kUnsupportedBaud:
      return "use a usual speed: 115200 or 250000";
    case PortProblem::kBadAddress:
      return "write tcp://HOST:PORT, with an IPv6 address in brackets: tcp://[fe80::1]:8888";
    case PortProblem::kUnknownHost:
      return "check the spelling, or use the number of the address";
    case PortProblem::kRefused:
      return "check the port number, and that the serial server (ser2net, ESP3D) runs and is free";
    case PortProblem::kUnreachable:
      return "check that the printer is switched on and in the same network";
    case PortProblem::kNoAnswer:
      return "check that this is the printer's port and that the printer is switched on";
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
    case ECONNRESET:
    case ECONNABORTED:
    case ETIMEDOUT:
    case EHOSTUNREACH:
    case ENETUNREACH:
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

namespace {

std::unique_ptr<Port> open_device(const std::string& path, const PortOptions& options) {
  std::error_code failed;
  const std::filesystem::path device = std::filesystem::canonical(path, failed);
  if (failed) throw port_error_from_errno(failed.value(), path);
  // libserialport knows a port by its entry here; a pseudo-terminal has none.
  if (std::filesystem::exists("/sys/class/tty" / device.filename(), failed)) {
    return std::make_unique<SerialPort>(device.string(), options);
  }
  return std::make_unique<PtyPort>(device.string(), options.baud);
}

}  // namespace

std::unique_ptr<Port> open_port(const std::string& path, const PortOptions& options) {
  if (is_tcp_address(path)) {
    return std::make_unique<TcpPort>(parse_tcp_address(path), options.connect_timeout);
  }
  if (options.baud != 0) return open_device(path, options);
  PortOptions first_try = options;
  first_try.baud = kUsualBauds.front();
  std::unique_ptr<Port> port = open_device(path, first_try);
  find_baud(*port);
  return port;
}

}  // namespace lamina::transport
