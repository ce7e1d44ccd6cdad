#pragma once

#include <string>

namespace lamina::tests {

/// A serial device that does not exist: for this process, /dev/NAME leads to a pseudo-terminal, and the calls
/// that a pseudo-terminal lacks (modem lines, serial settings, the entry in sysfs) behave as the kernel's
/// serial drivers do. So libserialport opens the emulated printer as it opens a real one. Everything that a
/// pseudo-terminal has is real: bytes, speeds (also 250000), locks, hang-up.
///
/// It works by this program's own open, close, ioctl, readlink, realpath and stat, which the dynamic linker
/// prefers to libc's for every library. Link pretend_serial.cpp into a program of its own. One device at a
/// time.
class PretendSerial {
 public:
  /// `pty`: what the device leads to.
  PretendSerial(const std::string& name, const std::string& pty);
  PretendSerial(const PretendSerial&) = delete;
  PretendSerial& operator=(const PretendSerial&) = delete;
  ~PretendSerial();

  std::string path() const;

  // What the host did.
  bool dtr() const;
  bool rts() const;
  int restarts() const;  ///< how often DTR rose: a board like an Arduino restarts
  bool low_latency() const;
  int open_descriptors() const;

  // What goes wrong.
  void refuse_open(int error);    ///< errno; 0: no more
  void refuse_speed(int baud);    ///< the driver cannot set this one; 0: no more
  void refuse_serial_settings();  ///< TIOCGSERIAL fails, as with many drivers
  /// The host's process dies: the kernel closes what it had open.
  void kill_host();
};

}  // namespace lamina::tests
