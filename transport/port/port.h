#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "transport/port/port_options.h"
#include "transport/time.h"

namespace lamina::transport {

/// What stands in the way of using a port.
enum class PortProblem {
  kNoSuchDevice,     ///< nothing at that path
  kPermission,       ///< the user may not open it
  kBusy,             ///< another program holds it
  kUnplugged,        ///< it was there, and is gone
  kNotATerminal,     ///< the path is no serial device and no pseudo-terminal
  kUnsupportedBaud,  ///< the device refuses that speed
  kBadAddress,       ///< a network address that is not tcp://HOST:PORT
  kUnknownHost,      ///< no such name in the network
  kRefused,          ///< the host is there, and nobody listens at that port of it
  kUnreachable,      ///< no way to the host, or no word from it in time
  kNoAnswer,         ///< nothing that speaks like a printer, at any of the usual speeds
  kSystem            ///< anything else; the message carries the system's words
};

/// A port could not be opened or used. `what()` is one line: path, what went wrong, what to do.
class PortError : public std::runtime_error {
 public:
  PortError(PortProblem problem, std::string path, const std::string& detail);

  PortProblem problem;
  std::string path;
  std::string hint;  ///< what the user can do, a phrase; empty where nothing helps
};

/// A PortError for the system's error number `error` (errno) on `path`.
PortError port_error_from_errno(int error, const std::string& path);

/// A byte pipe to a printer (or, on the emulator's side, to a host). Reading and writing never block; `wait`
/// does, and only for as long as it is told. All calls of one port come from one thread. Every call but
/// `close` and `name` throws PortError when the device has gone.
class Port {
 public:
  Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  virtual ~Port() = default;

  /// Moves bytes that have arrived into `into`. Returns how many, 0 if there are none now.
  virtual std::size_t read(std::span<char> into) = 0;

  /// Hands bytes over. Returns how many were taken, a prefix of `bytes`; 0 if the device takes none now.
  virtual std::size_t write(std::string_view bytes) = 0;

  /// Sleeps until bytes have arrived, or (with `until_writable`) the device takes bytes again, or `at_most`
  /// is over.
  virtual void wait(Duration at_most, bool until_writable) = 0;

  /// Throws away what was written and has not left yet, and what has arrived and was not read yet.
  virtual void discard() = 0;

  /// Gives the device free. What was written has up to a second to leave, unless the device failed before. A
  /// second call does nothing.
  virtual void close() = 0;

  /// Bits per second from now on. Ports without a serial line behind them ignore it.
  virtual void set_baud(int /*baud*/) {}

  /// What to call this port in a message: a path, an address, or "memory".
  virtual std::string name() const = 0;
};

/// Opens the printer at `path` for this program alone: a serial device through libserialport, a
/// pseudo-terminal through termios, "tcp://HOST:PORT" as a raw network connection (ser2net, ESP3D). Symbolic
/// links (/dev/serial/by-id/...) are followed. With a baud rate of 0 the rate is searched first (find_baud),
/// which takes some seconds. Throws PortError.
std::unique_ptr<Port> open_port(const std::string& path, const PortOptions& options = {});

}  // namespace lamina::transport
