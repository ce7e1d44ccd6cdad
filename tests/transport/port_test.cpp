#include "transport/port/port.h"

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/transport/port_reading.h"
#include "tests/transport/sample_print.h"
#include "tests/transport/served_printer.h"
#include "transport/emulator/emulator_server.h"
#include "transport/port/memory_port.h"
#include "transport/port/pty_host.h"
#include "transport/session/runner.h"

// These run in real time, on real pseudo-terminals.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;
using namespace lamina::tests;

/// Every byte there is, a few times over.
std::string every_byte() {
  std::string bytes;
  for (int i = 0; i < 1024; ++i) bytes += static_cast<char>(i);
  return bytes;
}

PortProblem problem_of(const std::string& path) {
  try {
    open_port(path);
  } catch (const PortError& error) {
    CHECK(std::string(error.what()).find(path) == 0);
    return error.problem;
  }
  return PortProblem::kSystem;
}

}  // namespace

TEST_CASE("port: a pseudo-terminal carries every byte both ways") {
  PtyHost device;
  const auto host = open_port(device.path());
  CHECK(host->name() == device.path());
  CHECK(host->write(every_byte()) == 1024);
  CHECK(read_within(device, 1024, 2s) == every_byte());
  CHECK(device.write(every_byte()) == 1024);
  CHECK(read_within(*host, 1024, 2s) == every_byte());
  // Nothing there: no waiting.
  std::array<char, 16> bytes;
  CHECK(host->read(bytes) == 0);
}

TEST_CASE("port: waiting ends when bytes come, or when the time is over") {
  PtyHost device;
  const auto host = open_port(device.path());
  const auto before = std::chrono::steady_clock::now();
  host->wait(50ms, false);
  CHECK(std::chrono::steady_clock::now() - before >= 45ms);
  device.write("x");
  host->wait(10s, false);
  CHECK(std::chrono::steady_clock::now() - before < 5s);
}

TEST_CASE("port: hosts may come and go") {
  PtyHost device;
  for (int round = 0; round < 3; ++round) {
    const auto host = open_port(device.path());
    device.write("a");
    CHECK(read_within(*host, 1, 2s) == "a");
    host->close();
    host->close();
    device.write("stale");
  }
  const auto host = open_port(device.path());
  std::array<char, 16> bytes;
  CHECK(host->read(bytes) == 0);
}

TEST_CASE("port: what is wrong with one is said") {
  CHECK(problem_of("/dev/no-such-printer") == PortProblem::kNoSuchDevice);
  const auto file = std::filesystem::temp_directory_path() / "lamina-port-test";
  std::ofstream(file) << "x";
  CHECK(problem_of(file.string()) == PortProblem::kNotATerminal);
  std::filesystem::remove(file);
  PtyHost device;
  const auto host = open_port(device.path());
  CHECK(problem_of(device.path()) == PortProblem::kBusy);
  device.close();
  std::array<char, 16> bytes;
  try {
    host->read(bytes);
    FAIL("a device that has gone must be noticed");
  } catch (const PortError& error) {
    CHECK(error.problem == PortProblem::kUnplugged);
    CHECK_FALSE(error.hint.empty());
  }
}

TEST_CASE("port: memory ports carry bytes between threads, and notice a closed end") {
  MemoryPorts ports = make_memory_ports();
  std::thread other([&] {
    CHECK(read_within(*ports.device, 1024, 5s) == every_byte());
    ports.device->write("done");
    ports.device->close();
  });
  ports.host->write(every_byte());
  CHECK(read_within(*ports.host, 4, 5s) == "done");
  other.join();
  std::array<char, 16> bytes;
  CHECK_THROWS_AS(ports.host->read(bytes), PortError);
  CHECK_THROWS_AS(ports.host->write("x"), PortError);
}

TEST_CASE("runner: a print over a real pseudo-terminal, in real time") {
  PtyHost device;
  ServedPrinter printer(device, fast_printer());
  const auto host = open_port(device.path());
  PrintJob job(source_of(sample_print(120)), quick_start());
  int progress_calls = 0;
  PrintCallbacks callbacks;
  callbacks.on_progress = [&](const JobProgress&) { ++progress_calls; };
  const std::atomic<bool> cancel = false;
  const PrintResult result = run_print(*host, job, callbacks, cancel);
  INFO(result.failure);
  CHECK(result.outcome == JobPhase::kCompleted);
  CHECK(result.progress.job_lines_sent == result.progress.job_lines_acknowledged);
  CHECK(result.progress.wire.resends == 0);
  CHECK(progress_calls > 10);
  CHECK(job.printer().firmware.machine == "Lamina Emulated Printer");
  CHECK(job.printer().can("ARCS"));
  REQUIRE(result.progress.temperatures.find("T") != nullptr);
  CHECK(printer.stop().report.beads == 120);
}

TEST_CASE("runner: a print over a memory port") {
  MemoryPorts ports = make_memory_ports();
  ServedPrinter printer(*ports.device, fast_printer());
  PrintJob job(source_of(sample_print(60)), quick_start());
  const std::atomic<bool> cancel = false;
  const PrintResult result = run_print(*ports.host, job, {}, cancel);
  CHECK(result.outcome == JobPhase::kCompleted);
  CHECK(printer.stop().report.beads == 60);
}

TEST_CASE("runner: cancelled while heating, it comes back with the heaters off") {
  PtyHost device;
  EmulatorServerOptions slow = fast_printer();
  slow.time_scale = 1;
  ServedPrinter printer(device, slow);
  const auto host = open_port(device.path());
  PrintJob job(source_of(sample_print(60)), quick_start());
  std::atomic<bool> cancel = false;
  PrintCallbacks callbacks;
  callbacks.on_event = [&](const Event& event) {
    const auto* sent = std::get_if<LineSent>(&event);
    if (sent != nullptr && sent->line.command == "M104 S200") cancel = true;
  };
  const PrintResult result = run_print(*host, job, callbacks, cancel);
  INFO(result.failure);
  CHECK(result.outcome == JobPhase::kCancelled);
  CHECK(result.elapsed < 20s);
}

TEST_CASE("runner: a printer that is unplugged ends the print with a reason") {
  MemoryPorts ports = make_memory_ports();
  PrintJob job(source_of(sample_print(60)), quick_start());
  const std::atomic<bool> cancel = false;
  std::thread unplug([&] {
    std::this_thread::sleep_for(300ms);
    ports.device->close();
  });
  const PrintResult result = run_print(*ports.host, job, {}, cancel);
  unplug.join();
  CHECK(result.outcome == JobPhase::kFailed);
  CHECK(result.failure.find("closed") != std::string::npos);
}
