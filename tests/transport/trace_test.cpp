#include "transport/trace/trace.h"

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/transport/sample_print.h"
#include "tests/transport/served_printer.h"
#include "transport/port/memory_port.h"
#include "transport/session/runner.h"
#include "transport/trace/replay.h"
#include "transport/trace/trace_file.h"
#include "transport/trace/tracing_port.h"

namespace {

using namespace lamina::transport;
using namespace lamina::tests;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

const std::array<std::string, 2> kGolden{
    std::string(LAMINA_SOURCE_DIR) + "/tests/golden/resends.trace",
    std::string(LAMINA_SOURCE_DIR) + "/tests/golden/packed_resends.trace"};

/// A file name in the temporary folder; the file goes with the object.
struct TemporaryFile {
  explicit TemporaryFile(const std::string& name)
      : path((fs::temp_directory_path() / ("lamina-" + std::to_string(::getpid()) + "-" + name)).string()) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  std::string path;
};

std::size_t wrong_line(const std::string& text) {
  try {
    parse_trace(text);
  } catch (const TraceError& error) {
    CHECK(std::string(error.what()).find("line " + std::to_string(error.line)) == 0);
    return error.line;
  }
  return 0;
}

/// A print on an emulated printer over a wire with faults, in real time, and its trace.
Trace traced_print(double fault_rate, const PrintJobOptions& options, const FirmwareFeatures& features = {}) {
  const TemporaryFile file("print.trace");
  MemoryPorts ports = make_memory_ports();
  EmulatorServerOptions server = fast_printer();
  server.time_scale = 100;
  server.emulator.features = features;
  server.to_printer.baud = server.to_host.baud = 115200;
  server.to_printer.faults.flip = server.to_host.faults.flip = fault_rate;
  server.to_printer.faults.spacing = 40;
  ServedPrinter printer(*ports.device, server);
  {
    TraceFile trace(file.path, TraceHeader{"memory", options.engine});
    TracingPort traced(*ports.host, trace);
    PrintJob job(source_of(sample_print(100)), options);
    const std::atomic<bool> cancel = false;
    const PrintResult result = run_print(traced, job, {}, cancel);
    INFO(result.failure);
    CHECK(result.outcome == JobPhase::kCompleted);
    CHECK((result.progress.wire.resends > 0) == (fault_rate > 0));
    CHECK(trace.failure().empty());
  }
  return read_trace(file.path);
}

/// Made once for all tests.
const Trace& clean_print() {
  static const Trace trace = traced_print(0, quick_start());
  return trace;
}

void check_same(const Trace& trace) {
  const ReplayResult result = replay(trace);
  if (result.difference) {
    INFO("at " << to_seconds(result.difference->at.time_since_epoch()) << " s, byte "
               << result.difference->position << ", after " << escaped(result.difference->before));
    INFO("traced   " << escaped(result.difference->traced));
    INFO("replayed " << escaped(result.difference->replayed));
    FAIL("the replay differs");
  }
}

}  // namespace

TEST_CASE("trace: text and trace are inverses, for every byte") {
  Trace trace;
  trace.header.port = "/dev/serial/by-id/a printer";
  trace.header.engine.window = {5, 200, false};
  trace.header.engine.baud = 250000;
  trace.header.engine.form.blanks = true;
  trace.header.engine.meatpack_after = 77;
  trace.header.engine.start_wait = 1234ms;
  std::string every_byte;
  for (int i = 0; i < 256; ++i) every_byte += static_cast<char>(i);
  trace.entries = {{Instant{0ns}, TraceEvent::kSent, "N0 M110 N0*125\n"},
                   {Instant{1ns}, TraceEvent::kReceived, every_byte},
                   {Instant{36000s + 7us}, TraceEvent::kDiscarded, ""},
                   {Instant{36000s + 7us}, TraceEvent::kSent, "\\x41 \\n"},
                   {Instant{36001s}, TraceEvent::kFailed, "gone"}};
  const Trace read = parse_trace(to_text(trace));
  CHECK(read.entries == trace.entries);
  CHECK(read.header.port == trace.header.port);
  CHECK(read.header.engine.window.lines == 5);
  CHECK(read.header.engine.window.bytes == 200);
  CHECK_FALSE(read.header.engine.window.hold_ends);
  CHECK(read.header.engine.baud == 250000);
  CHECK(read.header.engine.form.blanks);
  CHECK(read.header.engine.meatpack_after == 77);
  CHECK(read.header.engine.start_wait == 1234ms);
  // A line is a line, whatever its bytes.
  const std::string text = to_text(trace);
  const auto entries = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  CHECK(entries == 11 + 1 + trace.entries.size());  // the header ends with a blank line
}

TEST_CASE("trace: it reads like this") {
  std::string line;
  append_text(line, {Instant{2'500'113'020ns}, TraceEvent::kReceived, "ok\r\n\xff"});
  CHECK(line == "2.500113020 < ok\\r\\n\\xff\n");
}

TEST_CASE("trace: what is no trace is refused with its line") {
  const std::string header = to_text(TraceHeader{"p", {}});
  const auto first = static_cast<std::size_t>(std::count(header.begin(), header.end(), '\n')) + 1;
  CHECK(wrong_line("") == 1);
  CHECK(wrong_line("G28\n") == 1);
  CHECK(wrong_line("lamina trace 1\nwindow_lines many\n") == 2);
  CHECK(wrong_line("lamina trace 1\ncolour red\n") == 2);
  for (const char* const entry :
       {"1.5 > x", "1.500000000 ? x", "1.500000000", "-1.500000000 > x", "1.50000000a > x", "x",
        "1.500000000 > \\", "1.500000000 > \\q", "1.500000000 > \\x4", "1.500000000 > \\xZZ",
        "99999999999999999999.500000000 > x", "9999999999999.500000000 > x"}) {
    INFO(entry);
    CHECK(wrong_line(header + "1.000000000 > ok\n" + entry + "\n") == first + 1);
  }
  CHECK(wrong_line(header + "1.000000000 > x\n0.900000000 > x\n") == first + 1);
  // As a crash leaves it.
  CHECK(parse_trace(header + "1.000000000 > x\n1.10000").entries.size() == 1);
}

TEST_CASE("trace: a port writes down what passes, and its end") {
  const TemporaryFile file("port.trace");
  MemoryPorts ports = make_memory_ports();
  {
    TraceFile trace(file.path, TraceHeader{"memory", {}});
    TracingPort port(*ports.host, trace, 10);
    CHECK(port.name() == "memory");
    CHECK(port.write("M105\n") == 5);
    ports.device->write("ok\n");
    std::array<char, 16> bytes;
    CHECK(port.read(bytes) == 3);
    CHECK(port.read(bytes) == 0);
    port.wait(20ms, false);
    port.discard();
    ports.device->close();
    CHECK_THROWS_AS(port.read(bytes), PortError);
    port.close();
  }
  const Trace trace = read_trace(file.path);
  REQUIRE(trace.entries.size() == 4);
  CHECK(trace.entries[0].event == TraceEvent::kSent);
  CHECK(trace.entries[0].bytes == "M105\n");
  CHECK(trace.entries[1].event == TraceEvent::kReceived);
  CHECK(trace.entries[1].bytes == "ok\n");
  CHECK(trace.entries[2].event == TraceEvent::kDiscarded);
  // Ten times as fast as the clock.
  CHECK(trace.entries[2].at - trace.entries[1].at >= 200ms);
  CHECK(trace.entries[3].event == TraceEvent::kFailed);
  CHECK(trace.entries[3].bytes.find("closed") != std::string::npos);
}

TEST_CASE("trace: killed, it keeps what it had") {
  const TemporaryFile file("killed.trace");
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    TraceFile trace(file.path, TraceHeader{"p", {}});
    for (int i = 0; i < 100; ++i) trace.write({Instant{i * 1ms}, TraceEvent::kSent, "G1 X1\n"});
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(WIFSIGNALED(status));
  CHECK(read_trace(file.path).entries.size() == 100);
}

TEST_CASE("trace: a full disk ends the trace, and nothing else") {
  TraceFile trace("/dev/full", TraceHeader{"p", {}});
  CHECK(trace.failure().find("/dev/full") == 0);
  MemoryPorts ports = make_memory_ports();
  TracingPort port(*ports.host, trace);
  CHECK(port.write("M105\n") == 5);
  CHECK_THROWS_AS(TraceFile("/no-such-folder/print.trace", TraceHeader{}), std::system_error);
  CHECK_THROWS_AS(read_trace("/no-such-folder/print.trace"), std::system_error);
}

TEST_CASE("replay: a clean print comes out the same") {
  check_same(clean_print());
}

TEST_CASE("replay: a print with resends and probes comes out the same, and a changed one does not") {
  PrintJobOptions options = quick_start();
  options.engine.timeouts.silent_firmware = 1s;
  options.engine.timeouts.busy_firmware = 500ms;
  Trace trace = traced_print(0.002, options);
  trace.header.engine.timeouts = options.engine.timeouts;
  check_same(trace);
  const ReplayResult same = replay(trace);
  CHECK(same.statistics.resends > 0);
  CHECK_FALSE(same.events.empty());
  std::int64_t sent = 0;
  for (const TraceEntry& entry : trace.entries) {
    if (entry.event == TraceEvent::kSent) sent += static_cast<std::int64_t>(entry.bytes.size());
  }
  CHECK(same.bytes_sent == sent);

  // The last digit of a checksum in the middle changed by hand: found where it stands.
  Trace changed = trace;
  std::int64_t position = 0;
  for (TraceEntry& entry : changed.entries) {
    if (entry.event != TraceEvent::kSent) continue;
    if (position > sent / 2) {
      REQUIRE(entry.bytes.ends_with('\n'));
      entry.bytes[entry.bytes.size() - 2] = '?';
      position += static_cast<std::int64_t>(entry.bytes.size()) - 2;
      break;
    }
    position += static_cast<std::int64_t>(entry.bytes.size());
  }
  const ReplayResult different = replay(changed);
  REQUIRE(different.difference);
  CHECK(different.difference->position == position);
  CHECK(different.difference->traced.front() == '?');
}

TEST_CASE("replay: another engine is told from the one that was traced") {
  const Trace trace = clean_print();
  // A window of one line cannot have sent what was sent.
  Trace one_line = trace;
  one_line.header.engine.window.lines = 1;
  const ReplayResult narrower = replay(one_line);
  REQUIRE(narrower.difference);
  CHECK(narrower.difference->replayed.empty());
  CHECK(narrower.difference->traced.starts_with("N"));
  // An ok that never came: the lines behind it cannot have been sent.
  Trace deaf = trace;
  std::erase_if(deaf.entries, [](const TraceEntry& entry) { return entry.event == TraceEvent::kReceived; });
  CHECK(replay(deaf).difference);
}

TEST_CASE("replay: a trace that breaks off is replayed as far as it goes") {
  Trace trace = clean_print();
  for (const std::size_t part : {trace.entries.size() / 2, std::size_t{10}, std::size_t{1}, std::size_t{0}}) {
    trace.entries.resize(part);
    check_same(trace);
  }
  trace.entries.push_back({Instant{1h}, TraceEvent::kFailed, "unplugged"});
  trace.entries.push_back({Instant{1h}, TraceEvent::kSent, "never\n"});
  check_same(trace);
}

TEST_CASE("replay: prints of the past come out the same") {
  // Where the engine is to behave differently from now on, LAMINA_UPDATE_GOLDEN=1 prints and traces anew.
  if (std::getenv("LAMINA_UPDATE_GOLDEN") != nullptr) {
    FirmwareFeatures packed;
    packed.meatpack = true;
    packed.advanced_ok = true;
    PrintJobOptions options = quick_start();
    options.temperature_interval = Duration{};  // they would come a hundred times a second
    std::ofstream(kGolden[0], std::ios::binary) << to_text(traced_print(0.002, options));
    options.engine.meatpack_after = 500;
    std::ofstream(kGolden[1], std::ios::binary) << to_text(traced_print(0.001, options, packed));
  }
  for (const std::string& path : kGolden) {
    INFO(path);
    const Trace trace = read_trace(path);
    check_same(trace);
    CHECK(replay(trace).statistics.resends > 0);
  }
}

TEST_CASE("trace: what it costs", "[.cost]") {
  const TemporaryFile file("cost.trace");
  TraceFile trace(file.path, TraceHeader{"p", {}});
  constexpr int kEntries = 1'000'000;
  const TraceEntry sent{Instant{12345678912ns}, TraceEvent::kSent,
                        "N12345 G1 X123.456 Y78.901 E1.23456*99\n"};
  const auto before = std::chrono::steady_clock::now();
  for (int i = 0; i < kEntries; ++i) trace.write(sent);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
  WARN(took.count() / kEntries * 1e6 << " us and " << static_cast<double>(fs::file_size(file.path)) / kEntries
                                     << " bytes for an entry of " << sent.bytes.size() << " bytes");
}
