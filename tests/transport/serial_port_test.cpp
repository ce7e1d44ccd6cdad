#include "transport/port/serial_port.h"

#include <array>
#include <cerrno>
#include <optional>
#include <string>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/support/pretend_serial.h"
#include "tests/transport/mismatched_uart.h"
#include "tests/transport/sample_print.h"
#include "tests/transport/served_printer.h"
#include "transport/port/pty_host.h"
#include "transport/session/runner.h"

// libserialport for real, on a pseudo-terminal that passes for a serial device.

namespace {

using namespace lamina::transport;
using namespace lamina::tests;
using namespace std::chrono_literals;

std::optional<PortError> error_of(const std::string& path, const PortOptions& options = {}) {
  try {
    open_port(path, options);
  } catch (const PortError& error) {
    return error;
  }
  return std::nullopt;
}

/// The printer's end of a pseudo-terminal with a real line's manners: the printer runs at one speed, the host
/// at what it has set, and where they differ, bytes come out as a receiver would make them.
class PrinterLine : public Port {
 public:
  PrinterLine(PtyHost& device, int baud) : device_(device), baud_(baud) {}

  std::size_t read(std::span<char> into) override {
    std::array<char, 1024> bytes;
    const std::size_t count = device_.read(bytes);
    heard_ += through_uart({bytes.data(), count}, device_.host_baud(), baud_);
    const std::size_t given = heard_.copy(into.data(), into.size());
    heard_.erase(0, given);
    return given;
  }
  std::size_t write(std::string_view bytes) override {
    device_.write(through_uart(bytes, baud_, device_.host_baud()));
    return bytes.size();
  }
  void wait(Duration at_most, bool until_writable) override { device_.wait(at_most, until_writable); }
  void discard() override { device_.discard(); }
  void close() override { device_.close(); }
  std::string name() const override { return device_.name(); }

 private:
  PtyHost& device_;
  int baud_;
  std::string heard_;
};

}  // namespace

TEST_CASE("serial: bytes pass both ways, and no byte there is no hang-up") {
  PtyHost device;
  const PretendSerial serial("ttyPRETEND0", device.path());
  const auto port = open_port(serial.path());
  CHECK(dynamic_cast<SerialPort*>(port.get()) != nullptr);
  CHECK(port->name() == "/dev/ttyPRETEND0");
  std::array<char, 1024> bytes;
  CHECK(port->read(bytes) == 0);
  std::string every_byte;
  for (int i = 0; i < 256; ++i) every_byte += static_cast<char>(i);
  REQUIRE(port->write(every_byte) == 256);
  device.wait(1s, false);
  CHECK(std::string(bytes.data(), device.read(bytes)) == every_byte);
  REQUIRE(device.write(every_byte) == 256);
  port->wait(1s, false);
  CHECK(std::string(bytes.data(), port->read(bytes)) == every_byte);
  CHECK(port->read(bytes) == 0);
}

TEST_CASE("serial: every usual speed is set as asked, 250000 among them") {
  PtyHost device;
  const PretendSerial serial("ttyPRETEND0", device.path());
  for (const int baud : {9600, 57600, 115200, 230400, 250000, 500000, 1000000}) {
    PortOptions options;
    options.baud = baud;
    const auto port = open_port(serial.path(), options);
    CHECK(device.host_baud() == baud);
    port->set_baud(250000);
    CHECK(device.host_baud() == 250000);
  }
}

TEST_CASE("serial: a speed that the device refuses is said") {
  PtyHost device;
  PretendSerial serial("ttyPRETEND0", device.path());
  serial.refuse_speed(250000);
  PortOptions options;
  options.baud = 250000;
  const auto error = error_of(serial.path(), options);
  REQUIRE(error);
  CHECK(error->problem == PortProblem::kUnsupportedBaud);
  CHECK(std::string(error->what()).find("250000") != std::string::npos);
  CHECK(serial.open_descriptors() == 0);
  // The device is free again.
  CHECK_FALSE(error_of(serial.path()));
}

TEST_CASE("serial: a whole print through libserialport, at 250000 baud") {
  PtyHost device;
  const PretendSerial serial("ttyPRETEND0", device.path());
  ServedPrinter printer(device, fast_printer());
  PortOptions options;
  options.baud = 250000;
  const auto host = open_port(serial.path(), options);
  PrintJob job(source_of(sample_print(120)), quick_start());
  const std::atomic<bool> cancel = false;
  const PrintResult result = run_print(*host, job, {}, cancel);
  INFO(result.failure);
  CHECK(result.outcome == JobPhase::kCompleted);
  CHECK(result.progress.job_lines_sent == result.progress.job_lines_acknowledged);
  CHECK(result.progress.wire.resends == 0);
  CHECK(printer.stop().report.beads == 120);
}

TEST_CASE("serial: the speed of a printer is found, and the print goes on at it") {
  PtyHost device;
  const PretendSerial serial("ttyPRETEND0", device.path());
  PrinterLine line(device, 250000);
  ServedPrinter printer(line, fast_printer());
  PortOptions options;
  options.baud = 0;
  const auto host = open_port(serial.path(), options);
  CHECK(device.host_baud() == 250000);
  PrintJob job(source_of(sample_print(20)), quick_start());
  const std::atomic<bool> cancel = false;
  const PrintResult result = run_print(*host, job, {}, cancel);
  INFO(result.failure);
  CHECK(result.outcome == JobPhase::kCompleted);
  CHECK(printer.stop().report.beads == 20);
}

TEST_CASE("serial: at the wrong speed, nothing is taken for a printer") {
  PtyHost device;
  const PretendSerial serial("ttyPRETEND0", device.path());
  PrinterLine line(device, 250000);
  ServedPrinter printer(line, fast_printer());
  const auto host = open_port(serial.path());
  PrintJobOptions impatient = quick_start();
  impatient.engine.greeting_wait = 100ms;
  PrintJob job(source_of(sample_print(20)), impatient);
  const std::atomic<bool> cancel = false;
  const PrintResult result = run_print(*host, job, {}, cancel);
  CHECK(result.outcome == JobPhase::kFailed);
  CHECK(result.failure.find("speed") != std::string::npos);
  CHECK(printer.stop().report.beads == 0);
}

TEST_CASE("serial: what is wrong with a device is said, and nothing stays open") {
  PtyHost device;
  PretendSerial serial("ttyPRETEND0", device.path());
  const auto expect = [&](int error, PortProblem problem, const char* hint) {
    serial.refuse_open(error);
    const auto said = error_of(serial.path());
    REQUIRE(said);
    INFO(said->what());
    CHECK(said->problem == problem);
    CHECK(said->path == serial.path());
    CHECK(said->hint.find(hint) != std::string::npos);
    CHECK(serial.open_descriptors() == 0);
  };
  expect(EACCES, PortProblem::kPermission, "dialout");
  expect(EBUSY, PortProblem::kBusy, "lamina ports");
  expect(ENXIO, PortProblem::kUnplugged, "cable");
  expect(ENOENT, PortProblem::kNoSuchDevice, "plug");
  const auto said = error_of("/dev/ttyABSENT0");
  REQUIRE(said);
  CHECK(said->problem == PortProblem::kNoSuchDevice);
}

TEST_CASE("serial: a device is for one program at a time") {
  PtyHost device;
  const PretendSerial serial("ttyPRETEND0", device.path());
  const auto port = open_port(serial.path());
  const auto second = error_of(serial.path());
  REQUIRE(second);
  CHECK(second->problem == PortProblem::kBusy);
  CHECK(serial.open_descriptors() == 1);
  port->close();
  port->close();
  CHECK(serial.open_descriptors() == 0);
  CHECK_FALSE(error_of(serial.path()));
}

TEST_CASE("serial: unplugged in the middle of a print, it ends with that reason") {
  PtyHost device;
  const PretendSerial serial("ttyPRETEND0", device.path());
  ServedPrinter printer(device, fast_printer());
  const auto host = open_port(serial.path());
  const PrintResult result = print_until_unplugged(*host, printer, device);
  INFO(result.failure);
  CHECK(result.outcome == JobPhase::kFailed);
  CHECK(result.failure.find(serial.path()) == 0);
  CHECK(result.failure.find("heaters may still be on") != std::string::npos);
  std::array<char, 16> bytes;
  try {
    host->read(bytes);
    FAIL("a device that has gone must be noticed");
  } catch (const PortError& error) {
    CHECK(error.problem == PortProblem::kUnplugged);
  }
  // Nothing can leave any more, so the close does not wait for it.
  const auto before = std::chrono::steady_clock::now();
  host->close();
  CHECK(std::chrono::steady_clock::now() - before < 500ms);
}

TEST_CASE("serial: as wired, each open after a proper close restarts the board, and none after a crash") {
  PtyHost device;
  PretendSerial serial("ttyPRETEND0", device.path());
  for (int opens = 1; opens <= 2; ++opens) {
    const auto port = open_port(serial.path());
    CHECK(serial.dtr());
    CHECK(serial.rts());
    CHECK(serial.restarts() == opens);
    port->close();
    CHECK_FALSE(serial.dtr());
  }
  const auto killed = open_port(serial.path());
  CHECK(serial.restarts() == 3);
  serial.kill_host();
  CHECK(serial.dtr());
  const auto resumed = open_port(serial.path());
  CHECK(serial.restarts() == 3);
}

TEST_CASE("serial: a restart can be forced, and avoided") {
  PtyHost device;
  const PretendSerial serial("ttyPRETEND0", device.path());
  PortOptions avoid;
  avoid.restart = BoardRestart::kAvoid;
  open_port(serial.path(), avoid)->close();
  CHECK(serial.dtr());
  open_port(serial.path(), avoid)->close();
  CHECK(serial.restarts() == 1);

  PortOptions force;
  force.restart = BoardRestart::kForce;
  const auto before = std::chrono::steady_clock::now();
  const auto port = open_port(serial.path(), force);
  CHECK(serial.restarts() == 2);
  CHECK(serial.dtr());
  CHECK(serial.rts());
  CHECK(std::chrono::steady_clock::now() - before >= 200ms);
}

TEST_CASE("serial: adapters are asked to pass bytes on at once, and may decline") {
  PtyHost device;
  PretendSerial serial("ttyPRETEND0", device.path());
  open_port(serial.path())->close();
  CHECK(serial.low_latency());
  serial.refuse_serial_settings();
  CHECK_FALSE(error_of(serial.path()));
}
