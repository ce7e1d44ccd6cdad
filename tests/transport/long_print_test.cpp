#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <malloc.h>

#include "transport/emulator/print_on_emulator.h"

// A print of ten hours in seconds, and with a memory that does not grow.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;

/// Bytes that the program holds from the heap.
std::size_t heap() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace

TEST_CASE("long print: ten hours in simulated time, memory flat") {
  constexpr int kMoves = 36'000;  // of 50 mm at 50 mm/s: a second each
  int made = 0;
  const LineSource source = [&]() -> std::optional<std::string> {
    if (made == kMoves) return std::nullopt;
    const int i = made++;
    if (i == 0) return "M83";
    if (i % 3000 == 0) return fmt::format("G1 Z{:.2f} F600", 0.2 + 0.2 * (i / 3000));
    return fmt::format("G1 X{} Y{:.2f} E1.5 F3000", 100 + (i % 2) * 50, 50 + 0.01 * (i % 100));
  };
  EmulatedPrintOptions options;
  options.emulator.thermal.room = 200;
  options.emulator.features.advanced_ok = true;
  options.to_printer.baud = options.to_host.baud = 115200;
  options.time_limit = 24h;
  std::size_t early = 0;
  std::size_t most = 0;
  std::size_t most_events = 0;
  std::size_t events = 0;
  options.callbacks.on_event = [&](const Event&) { ++events; };
  options.steer = [&](PrintJob& job, Instant now) {
    most_events = std::max(most_events, std::exchange(events, 0));
    // Once an hour or so.
    if (now.time_since_epoch() < 30min || job.progress().source_lines % 2000 != 0) return;
    if (early == 0) early = heap();
    most = std::max(most, heap());
  };
  const EmulatedPrint print = print_on_emulator(source, options);
  REQUIRE(print.result.outcome == JobPhase::kCompleted);
  CHECK(print.result.elapsed > 10h);
  CHECK(print.report.beads >= kMoves - kMoves / 3000 - 2);
  CHECK(print.report.underruns == 0);
  CHECK(print.result.progress.wire.resends == 0);
  CHECK(most_events < 100);
  if (early == 0) {
    WARN("the heap does not tell its size, as with a sanitizer");
    return;
  }
  // Whatever is held at half an hour is held at ten hours; a byte per line would be 34,000.
  CHECK(most < early + 16 * 1024);
}
