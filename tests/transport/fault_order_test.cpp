#include "transport/emulator/fault_order.h"

#include <string>

#include <catch2/catch.hpp>

#include "tests/transport/sample_print.h"
#include "transport/emulator/emulator.h"
#include "transport/emulator/print_on_emulator.h"
#include "transport/protocol/line_framing.h"

// Faults to order: how they are written, what each does to the printer's words, and that a print survives
// those that can be survived and names those that cannot.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;
using lamina::tests::sample_print;
using lamina::tests::source_of;

/// A printer with one fault, spoken to in numbered lines.
struct Talk {
  explicit Talk(const std::string& fault) {
    EmulatorOptions options;
    options.greet = false;
    options.faults = {parse_fault_order(fault)};
    printer.emplace(options);
    say("N0 M110 N0*125\n");
  }

  std::string say(const std::string& bytes, Duration listen = 0s) {
    printer->receive(bytes, now);
    return hear(listen);
  }
  std::string hear(Duration listen) {
    now += listen;
    printer->advance(now);
    return printer->take_output();
  }

  Instant now{};
  std::optional<Emulator> printer;
};

std::string line(LineNumber number) {
  return frame_line(number, "M220 S100");
}

const std::string kAgain1 = "Resend: 1\nok\n";

EmulatedPrintOptions with_fault(const std::string& fault) {
  EmulatedPrintOptions options;
  options.emulator.record = RecordDetail::kBeads;
  options.emulator.faults = {parse_fault_order(fault)};
  give_to_wires(options.emulator.faults, options.to_printer.faults, options.to_host.faults);
  options.emulator.serial.overflow = Overflow::kLose;
  options.to_printer.baud = options.to_host.baud = 115200;
  options.time_limit = 3h;
  return options;
}

}  // namespace

TEST_CASE("fault order: text and order are inverses") {
  for (const std::string text :
       {"flip=1@byte:12", "drop-reply=1@chance:0.001", "lose-ok=1@line:50", "stall=5@time:30.5",
        "say=//action:pause now@command:20", "mangle-ok=@line:7", "refuse-number=3@line:4",
        "silence=0@time:10", "unplug=1@command:3"}) {
    CHECK(text_of(parse_fault_order(text)) == text);
  }
  CHECK(parse_fault_order("stall@time:1").amount == 5);
  CHECK(parse_fault_order("say=a@b=c@line:3").text == "a@b=c");
}

TEST_CASE("fault order: what cannot be understood is named") {
  for (const std::string text :
       {"", "lose-ok", "lose-ok@", "lose-ok@line", "lose-ok@line:x", "lose-ok@tomorrow:3", "burn@line:3",
        "stall=long@time:3", "flip@line:3", "stall@byte:3", "flip@chance:2", "stall=-1@time:3"}) {
    INFO(text);
    CHECK_THROWS_AS(parse_fault_order(text), FaultOrderError);
  }
  CHECK_THROWS_WITH(parse_fault_order("burn@line:3"),
                    Catch::Contains("burn@line:3") && Catch::Contains("no fault"));
}

TEST_CASE("faults: oks are lost, doubled and mangled, one each") {
  CHECK(Talk("lose-ok@line:1").say(line(1) + line(2)) == "ok\n");
  CHECK(Talk("repeat-ok@line:1").say(line(1) + line(2)) == "ok\nok\nok\n");
  CHECK(Talk("mangle-ok=okok@line:2").say(line(1) + line(2)) == "ok\nokok\n");
}

TEST_CASE("faults: good lines are refused in Marlin's words") {
  CHECK(Talk("refuse-checksum@line:1").say(line(1)) == "Error:checksum mismatch, Last Line: 0\n" + kAgain1);
  CHECK(Talk("refuse-missing@line:1").say(line(1)) ==
        "Error:No Checksum with line number, Last Line: 0\n" + kAgain1);
  CHECK(Talk("refuse-silently@line:1").say(line(1)) == "Error:No Line Number with checksum, Last Line: 0\n");
  Talk twice("refuse-number=2@line:1");
  const std::string refusal = "Error:Line Number is not Last Line Number+1, Last Line: 0\n" + kAgain1;
  CHECK(twice.say(line(1)) == refusal);
  CHECK(twice.say(line(1)) == refusal);
  CHECK(twice.say(line(1)) == "ok\n");
  CHECK(Talk("resend-storm=2@line:1").say(line(1)) == "Resend: 2\nok\nResend: 2\nok\nok\n");
}

TEST_CASE("faults: stalls, silence, a full buffer, words") {
  Talk stalled("stall=5@line:1");
  CHECK(stalled.say(line(1)).empty());
  CHECK(stalled.hear(4900ms).empty());
  CHECK(stalled.hear(200ms) == "ok\n");
  Talk silent("silence=5@line:1");
  CHECK(silent.say(line(1)).empty());
  CHECK(silent.hear(6s).empty());  // it was run, and nobody heard
  CHECK(silent.say(line(2)) == "ok\n");
  Talk full("full-buffer=5@line:1");
  CHECK(full.say(line(1)) == "ok\n");
  CHECK(full.say(line(2), 6s).empty());
  CHECK(full.say(line(2)) == "ok\n");
  CHECK(Talk("say=hello@line:1").say(line(1)) == "hello\nok\n");
  Talk unplugged("unplug@time:5");
  CHECK(unplugged.say(line(1)) == "ok\n");
  CHECK(unplugged.hear(6s).empty());
  CHECK(unplugged.say(line(2), 60s).empty());
}

TEST_CASE("faults: an error line that takes its time leaves the tail of the next line to run") {
  EmulatorOptions options;
  options.greet = false;
  options.serial.refusal_time = 5ms;
  Emulator printer(options);
  Instant now{};
  printer.receive("N0 M110 N0*125\n", now);
  printer.receive("N1 G1 X1*0\nN2 G4 P1", now);
  CHECK(printer.take_output() == "ok\nError:checksum mismatch, Last Line: 0\n");
  now += 6ms;
  printer.advance(now);
  CHECK(printer.take_output() == kAgain1);
  printer.receive("00*1\n", now);
  CHECK(printer.take_output() == "echo:Unknown command: \"00\"\nok\n");
}

TEST_CASE("faults: a heater that fails is found out by the thermal protection") {
  EmulatorOptions options;
  options.greet = false;
  SECTION("while it heats up") {
    options.faults = {parse_fault_order("heater-fails@command:1")};
    Emulator printer(options);
    printer.receive("G4 P1\nM109 S200\n", {});
    printer.advance(Instant(25s));
    CHECK(printer.halted());
    CHECK_THAT(printer.take_output(),
               Catch::Contains("Error:Heating failed, system stopped! Heater_ID: E0\n\necho:Heating Failed\n"
                               "Error:Printer halted. kill() called!\n"));
  }
  SECTION("when it was hot") {
    options.faults = {parse_fault_order("heater-fails@time:200")};
    Emulator printer(options);
    printer.receive("M109 S200\n", {});
    printer.advance(Instant(199s));
    CHECK_FALSE(printer.halted());
    // It has to lose four degrees, and then forty seconds go by.
    printer.advance(Instant(239s));
    CHECK_FALSE(printer.halted());
    printer.advance(Instant(260s));
    CHECK(printer.halted());
    CHECK_THAT(printer.take_output(),
               Catch::Contains("Error:Thermal Runaway, system stopped! Heater_ID: E0\n"));
  }
  SECTION("a healthy one is left alone, also when it cools down to a new target") {
    Emulator printer(options);
    printer.receive("M140 S60\nM109 S220\nM104 S150\n", {});
    printer.advance(Instant(1h));
    CHECK_FALSE(printer.halted());
    CHECK(printer.machine().heating());
  }
}

TEST_CASE("faults: a print survives what can be survived, and deposits the same") {
  const auto lines = sample_print(120);
  EmulatedPrintOptions straight;
  straight.emulator.record = RecordDetail::kBeads;
  const EmulatedPrint clean = print_on_emulator(source_of(lines), straight);
  const std::string fault = GENERATE(
      as<std::string>{}, "lose-ok@line:40", "repeat-ok@line:40", "mangle-ok=k@line:40",
      "mangle-ok=okok@line:40", "refuse-number@line:40", "refuse-checksum=5@line:40",
      "refuse-missing@line:40", "refuse-silently@line:40", "resend-storm=20@line:40", "stall=8@line:40",
      "silence=3@line:40", "full-buffer=0.05@line:40", "say=//action:notification x@line:40", "flip@byte:900",
      "drop@byte:900", "repeat@byte:900", "flip-reply@byte:700", "drop-reply@byte:700",
      "repeat-reply@byte:700", "insert-reply@byte:700");
  const std::size_t window = GENERATE(std::size_t{1}, std::size_t{3});
  EmulatedPrintOptions options = with_fault(fault);
  options.job.engine.window.lines = window;
  const EmulatedPrint print = print_on_emulator(source_of(lines), options);
  INFO(fault << ", window " << window << ": " << print.result.failure);
  REQUIRE(print.result.outcome == JobPhase::kCompleted);
  CHECK(print.beads == clean.beads);
  CHECK(print.report.doubled_lines == 0);
  CHECK(print.report.skipped_lines == 0);
}

TEST_CASE("faults: a print ends with the reason of what cannot be survived") {
  const auto [fault, words] = GENERATE(table<std::string, std::string>({
      {"restart@line:40", "restarted in the middle"},
      {"restart=2@line:40", "restarted in the middle"},
      {"thermal-runaway@line:40", "Thermal Runaway"},
      {"heater-fails@line:40", "too cold"},  // before the protection's forty seconds are over
      {"unplug@line:40", "does not answer"},
      {"silence@line:40", "does not answer"},
      {"refuse-checksum=50@line:40", "times in a row"},
  }));
  // Long enough for a nozzle to cool down.
  const EmulatedPrint print = print_on_emulator(source_of(sample_print(4000)), with_fault(fault));
  INFO(fault);
  CHECK(print.result.outcome == JobPhase::kFailed);
  CHECK_THAT(print.result.failure, Catch::Contains(words));
}

TEST_CASE("faults: a restart whose start is lost in noise is noticed all the same") {
  EmulatedPrintOptions options = with_fault("restart@line:60");
  options.emulator.power_up_noise = "\x01\x7f";  // glued to the line
  const EmulatedPrint print = print_on_emulator(source_of(sample_print(120)), options);
  CHECK_THAT(print.result.failure, Catch::Contains("restarted in the middle"));
}

TEST_CASE("faults: a firmware that lies in M115 is found out") {
  EmulatedPrintOptions options = with_fault("lose-ok@line:100000");
  options.emulator.claims = {{"MEATPACK", true}, {"AUTOREPORT_TEMP", true}};
  options.emulator.features.auto_report = false;
  const EmulatedPrint print = print_on_emulator(source_of(sample_print(60)), options);
  CHECK(print.result.outcome == JobPhase::kCompleted);
  CHECK(print.report.beads == 60);
}
