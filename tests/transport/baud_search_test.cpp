#include "transport/port/baud_search.h"

#include <optional>
#include <string>

#include <catch2/catch.hpp>

#include "tests/transport/mismatched_uart.h"
#include "transport/emulator/emulator.h"
#include "transport/port/memory_port.h"

namespace {

using namespace lamina::transport;
using namespace lamina::tests;
using namespace std::chrono_literals;

/// An emulated printer that talks at one speed and hears through a real receiver at another.
class PrinterAt {
 public:
  PrinterAt(int baud, EmulatorOptions options, Instant now)
      : baud_(baud), emulator_(std::move(options), now) {}

  void hear(std::string_view bytes, int host_baud, Instant now) {
    emulator_.receive(through_uart(bytes, host_baud, baud_), now);
  }
  std::string speak(int host_baud, Instant now) {
    emulator_.advance(now);
    return through_uart(emulator_.take_output(), baud_, host_baud);
  }
  Emulator& emulator() { return emulator_; }

 private:
  int baud_;
  Emulator emulator_;
};

struct Search {
  BaudSearch::State state;
  int baud;
  Duration took;
  int tries;
};

/// The search against the printer in simulated time, a millisecond a step; the printer says hello `boot`
/// after the port was opened.
Search search_for(int printer_baud, Duration boot, const BaudSearchOptions& options = {},
                  const std::string& half_sent = "") {
  Instant now{};
  EmulatorOptions printer_options;
  printer_options.greet = boot < options.boot_wait;
  std::optional<PrinterAt> printer;
  BaudSearch search(options);
  search.start(now);
  int baud = 0;
  int tries = 0;
  while (search.state() == BaudSearch::State::kSearching) {
    if (!printer && now.time_since_epoch() >= boot) {
      printer.emplace(printer_baud, printer_options, now);
      printer->hear(half_sent, printer_baud, now);
    }
    if (search.baud() != baud) {
      baud = search.baud();
      ++tries;
    }
    const std::string question = search.take_output();
    if (printer) {
      printer->hear(question, baud, now);
      search.receive(printer->speak(baud, now), now);
    }
    if (now >= search.deadline()) search.tick(now);
    now += 1ms;
    REQUIRE(now.time_since_epoch() < 60s);
  }
  return {search.state(), search.baud(), now.time_since_epoch(), tries};
}

}  // namespace

TEST_CASE("uart model: at the same speed every byte comes through, at another hardly any") {
  std::string every_byte;
  for (int i = 0; i < 256; ++i) every_byte += static_cast<char>(i);
  CHECK(through_uart(every_byte, 115200, 115200) == every_byte);
  // An AVR at "115200" runs at 111111; a receiver tolerates that.
  CHECK(through_uart(every_byte, 111111, 115200) == every_byte);
  CHECK(through_uart("", 115200, 9600).empty());
  const std::string talk = "ok T:20.62 /0.00 B:20.62 /0.00 @:0 B@:0\n";
  for (const int sent : kUsualBauds) {
    for (const int received : kUsualBauds) {
      if (sent != received) CHECK(through_uart(talk, sent, received).find("ok T:") == std::string::npos);
    }
  }
}

TEST_CASE("baud search: every usual speed is found, whether the board restarts or not") {
  for (const int baud : kUsualBauds) {
    for (const Duration boot : {Duration{0}, Duration{900ms}, Duration{10ms}}) {
      const Search found = search_for(baud, boot);
      INFO(baud << " baud, up after " << to_seconds(boot) << " s");
      CHECK(found.state == BaudSearch::State::kFound);
      CHECK(found.baud == baud);
      CHECK(found.took < 15s);
    }
  }
}

TEST_CASE("baud search: a printer that says nothing by itself is asked") {
  BaudSearchOptions no_boot;
  no_boot.boot_wait = Duration{};
  for (const int baud : kUsualBauds) {
    const Search found = search_for(baud, 0s, no_boot);
    CHECK(found.state == BaudSearch::State::kFound);
    CHECK(found.baud == baud);
    CHECK(found.took < 5s);
  }
}

TEST_CASE("baud search: half a line in the printer's buffer does not hide the question") {
  BaudSearchOptions no_boot;
  no_boot.boot_wait = Duration{};
  const Search found = search_for(250000, 0s, no_boot, "N5 G1 X10 Y");
  CHECK(found.state == BaudSearch::State::kFound);
  CHECK(found.baud == 250000);
}

TEST_CASE("baud search: silence is given up on, in bounded time") {
  const Search failed = search_for(115200, 100s);
  CHECK(failed.state == BaudSearch::State::kFailed);
  CHECK(failed.took < 16s);
  CHECK(failed.tries == 2 * static_cast<int>(kUsualBauds.size()));
}

TEST_CASE("baud search: other speeds, echoes and other devices are no printers") {
  // A speed that is not on the list.
  CHECK(search_for(74880, 0s).state == BaudSearch::State::kFailed);
  const auto talk_to = [](auto&& answer) {
    BaudSearch search;
    Instant now{};
    search.start(now);
    while (search.state() == BaudSearch::State::kSearching) {
      search.receive(answer(search.take_output()), now);
      if (now >= search.deadline()) search.tick(now);
      now += 10ms;
      REQUIRE(now.time_since_epoch() < 60s);
    }
    return search.state();
  };
  CHECK(talk_to([](const std::string& sent) { return sent; }) == BaudSearch::State::kFailed);
  CHECK(talk_to([](const std::string& sent) {
          return sent.empty() ? std::string() : "$GPGGA,123519,4807.038,N\r\nERROR\r\n";
        }) == BaudSearch::State::kFailed);
}

TEST_CASE("baud search: a printer that heats up is known by its reports") {
  BaudSearch search;
  Instant now{};
  search.start(now);
  while (search.state() == BaudSearch::State::kSearching) {
    search.take_output();
    // Deaf inside M109, and at the second rate of the list.
    const bool report = now.time_since_epoch() % 1s == Duration{};
    if (report)
      search.receive(through_uart(" T:120.62 /200.00 B:60.00 /60.00 @:127 B@:9 W:?\n", 250000, search.baud()),
                     now);
    if (now >= search.deadline()) search.tick(now);
    now += 10ms;
    REQUIRE(now.time_since_epoch() < 60s);
  }
  CHECK(search.state() == BaudSearch::State::kFound);
  CHECK(search.baud() == 250000);
}

TEST_CASE("baud search: a rate that the device refuses is passed over") {
  BaudSearchOptions options;
  options.bauds = {123, 115200};
  BaudSearch search(options);
  search.start(Instant{});
  CHECK(search.baud() == 123);
  search.refuse(Instant{});
  CHECK(search.baud() == 115200);
}

TEST_CASE("baud search: by the clock, on a port without a speed, the first rate is the right one") {
  MemoryPorts ports = make_memory_ports();
  ports.device->write("start\necho:Marlin 2.1.2.1\n");
  CHECK(find_baud(*ports.host) == kUsualBauds.front());

  // Nobody there.
  BaudSearchOptions quick;
  quick.boot_wait = 20ms;
  quick.answer_waits = {5ms, 5ms};
  try {
    find_baud(*ports.host, quick);
    FAIL("there is no printer");
  } catch (const PortError& error) {
    CHECK(error.problem == PortProblem::kNoAnswer);
  }
  ports.device->close();
  CHECK_THROWS_AS(find_baud(*ports.host, quick), PortError);
}
