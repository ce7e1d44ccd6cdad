#include "transport/protocol/reply.h"

#include <random>
#include <string>

#include <catch2/catch.hpp>

using namespace lamina::transport;

TEST_CASE("reply: ok in all its forms") {
  for (const std::string line : {"ok", "ok ", " ok", "OK", "okok", "ok\t"}) {
    INFO(line);
    const Reply reply = parse_reply(line);
    REQUIRE(std::holds_alternative<OkReply>(reply));
    CHECK_FALSE(std::get<OkReply>(reply).number);
    CHECK_FALSE(std::get<OkReply>(reply).temperatures);
  }
  const auto advanced = std::get<OkReply>(parse_reply("ok N3 P14 B3"));
  CHECK(advanced.number == 3);
  CHECK(advanced.planner_free == 14);
  CHECK(advanced.queue_free == 3);
  const auto unnumbered = std::get<OkReply>(parse_reply("ok P15 B3"));
  CHECK_FALSE(unnumbered.number);
  CHECK(unnumbered.planner_free == 15);
  CHECK(std::get<OkReply>(parse_reply("ok N-5 P15 B3")).number == -5);
  CHECK(std::get<OkReply>(parse_reply("echo:ok")).glued);
  CHECK(std::get<OkReply>(parse_reply("File deleted:a.gcook")).glued);
  for (const std::string line : {"okay", "o", "k", "ok5", "oK2", "notok"}) {
    INFO(line);
    CHECK(std::holds_alternative<TextReply>(parse_reply(line)));
  }
}

TEST_CASE("reply: resend requests in all spellings") {
  for (const std::string line :
       {"Resend: 6", "Resend:6", "resend: 6", "Resend: N6", "rs 6", "rs N6", "rs:6", "RESEND 6"}) {
    INFO(line);
    const Reply reply = parse_reply(line);
    REQUIRE(std::holds_alternative<ResendReply>(reply));
    CHECK(std::get<ResendReply>(reply).number == 6);
  }
  CHECK(std::get<ResendReply>(parse_reply("Resend: -1")).number == -1);
  CHECK(std::holds_alternative<TextReply>(parse_reply("Resend:")));
  CHECK(std::holds_alternative<TextReply>(parse_reply("rsync 5")));
  CHECK(std::holds_alternative<TextReply>(parse_reply("Resend: 99999999999999999999999999")));
}

TEST_CASE("reply: errors by what they mean") {
  const auto error = [](const std::string& line) { return std::get<ErrorReply>(parse_reply(line)); };
  CHECK(error("Error:checksum mismatch, Last Line: 5").severity == ErrorClass::kProtocol);
  CHECK(error("Error:checksum mismatch, Last Line: 5").last_line == 5);
  CHECK(error("Error:Line Number is not Last Line Number+1, Last Line: 41").last_line == 41);
  CHECK(error("Error:No Checksum with line number, Last Line: 5").severity == ErrorClass::kProtocol);
  CHECK(error("Error:Printer halted. kill() called!").severity == ErrorClass::kFatal);
  CHECK(error("Error:Heating failed, system stopped! Heater_ID: E0").severity == ErrorClass::kFatal);
  CHECK(error("Error:Thermal Runaway, system stopped! Heater_ID: bed").severity == ErrorClass::kFatal);
  CHECK(error("!! printer on fire").severity == ErrorClass::kFatal);
  CHECK(std::holds_alternative<TextReply>(parse_reply("!!T:53.93 /200.00")));
  CHECK(error("Error:G2/G3 bad parameters").severity == ErrorClass::kWarning);
  CHECK(error("Error:G2/G3 bad parameters").text == "G2/G3 bad parameters");
}

TEST_CASE("reply: temperatures, alone, with an ok, and while waiting") {
  const auto report = std::get<TemperatureReport>(parse_reply(" T:20.62 /60.00 B:21.50 /0.00 @:127 B@:3"));
  REQUIRE(report.heaters.size() == 2);
  CHECK(report.find("T")->current == 20.62);
  CHECK(report.find("T")->target == 60);
  CHECK(report.find("T")->power == 127);
  CHECK(report.find("B")->current == 21.5);
  CHECK(report.find("B")->power == 3);
  CHECK(report.find("C") == nullptr);
  CHECK_FALSE(report.waiting);

  const auto answer = std::get<OkReply>(parse_reply("ok T:20.62 /0.00 B:20.62 /0.00 @:0 B@:0"));
  REQUIRE(answer.temperatures);
  CHECK(answer.temperatures->find("T")->current == 20.62);

  CHECK(std::get<TemperatureReport>(parse_reply(" T:20.62 /60.00 B:20.62 /0.00 @:127 B@:0 W:?")).waiting);
  CHECK(std::get<TemperatureReport>(parse_reply("T:59.1 /60.0 W:7")).waiting);

  const auto two = std::get<TemperatureReport>(
      parse_reply(" T:1.00 /0.00 B:2.00 /0.00 T0:3.00 /4.00 T1:5.00 /6.00 @:0 B@:1 @0:2 @1:3"));
  REQUIRE(two.heaters.size() == 4);
  CHECK(two.find("T1")->target == 6);
  CHECK(two.find("T1")->power == 3);
  CHECK(two.find("T0")->power == 2);
  CHECK(std::get<TemperatureReport>(parse_reply("T:-15.00 /0.00 (1023.00) @:0")).find("T")->current == -15);
}

TEST_CASE("reply: everything else that a Marlin says") {
  CHECK(std::holds_alternative<StartReply>(parse_reply("start")));
  CHECK(std::holds_alternative<TextReply>(parse_reply("started")));
  CHECK(std::holds_alternative<WaitReply>(parse_reply("wait")));
  CHECK(std::get<BusyReply>(parse_reply("echo:busy: processing")).reason == BusyReason::kProcessing);
  CHECK(std::get<BusyReply>(parse_reply("echo:busy: paused for user")).reason == BusyReason::kPausedForUser);
  CHECK(std::get<BusyReply>(parse_reply("busy: paused for input")).reason == BusyReason::kPausedForInput);
  CHECK(std::get<UnknownCommandReply>(parse_reply("echo:Unknown command: \"4 G1 X4\"")).command == "4 G1 X4");

  const auto position =
      std::get<PositionReply>(parse_reply("X:50.00 Y:-1.50 Z:5.00 E:0.25 Count X:4000 Y:4000 Z:2000"));
  CHECK(position.x == 50);
  CHECK(position.y == -1.5);
  CHECK(position.z == 5);
  CHECK(position.e == 0.25);

  const auto firmware = std::get<FirmwareReply>(parse_reply(
      "FIRMWARE_NAME:Marlin 2.1.2.1 (May 16 2023 12:00:00) SOURCE_CODE_URL:github.com/MarlinFirmware/Marlin "
      "PROTOCOL_VERSION:1.0 MACHINE_TYPE:My Printer 3 EXTRUDER_COUNT:2 UUID:cede2a2f"));
  CHECK(firmware.firmware == "Marlin 2.1.2.1 (May 16 2023 12:00:00)");
  CHECK(firmware.machine == "My Printer 3");
  CHECK(firmware.extruders == 2);

  CHECK(std::get<CapabilityReply>(parse_reply("Cap:ARCS:1")).present);
  CHECK_FALSE(std::get<CapabilityReply>(parse_reply("Cap:EMERGENCY_PARSER:0")).present);
  CHECK(std::get<CapabilityReply>(parse_reply("Cap:EMERGENCY_PARSER:0")).name == "EMERGENCY_PARSER");
  CHECK(std::get<HostActionReply>(parse_reply("//action:pause")).action == "pause");
  CHECK(std::get<HostActionReply>(parse_reply("// action:resume")).action == "resume");
  const auto notification = std::get<HostActionReply>(parse_reply("//action:notification Heating done"));
  CHECK(notification.action == "notification");
  CHECK(notification.text == "Heating done");
  CHECK(std::get<TextReply>(parse_reply("echo:Settings Stored")).text == "echo:Settings Stored");
}

TEST_CASE("reply: lines are put together from pieces, whatever their ends") {
  ReplyLines lines;
  CHECK(lines.push("o").empty());
  CHECK(lines.push("k\r") == std::vector<std::string>{"ok"});
  CHECK(lines.push("\n\n").empty());
  CHECK(lines.push("a\nb\r\nc") == std::vector<std::string>{"a", "b"});
  CHECK(lines.push("d\n") == std::vector<std::string>{"cd"});
  const auto noise = lines.push(std::string(3 * ReplyLines::kMaxReplyBytes, 'x'));
  REQUIRE(noise.size() == 3);
  CHECK(noise.front().size() == ReplyLines::kMaxReplyBytes);
}

TEST_CASE("reply: numbers that noise has made impossible are not taken") {
  const auto report = std::get<TemperatureReport>(parse_reply(" T:20.0 /0.0 @:70000000000000000000"));
  CHECK_FALSE(report.heaters.front().power);
  const auto ok = std::get<OkReply>(parse_reply("ok N3 P99999999999 B-1"));
  CHECK(ok.number == 3);
  CHECK_FALSE(ok.planner_free);
  CHECK_FALSE(ok.queue_free);
}

TEST_CASE("reply: noise is text, never a crash") {
  const std::uint64_t seed = 20261122;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  const std::vector<std::string> real{"ok N3 P14 B3",
                                      "Resend: 6",
                                      "Error:checksum mismatch, Last Line: 5",
                                      " T:20.62 /60.00 B:20.62 /0.00 @:127 B@:0 W:?",
                                      "X:50.00 Y:50.00 Z:5.00 E:0.00 Count X:1",
                                      "Cap:ARCS:1",
                                      "//action:pause",
                                      "FIRMWARE_NAME:a MACHINE_TYPE:b EXTRUDER_COUNT:1"};
  std::size_t resends = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string line = real[random() % real.size()];
    for (std::uint64_t damage = random() % 5; damage > 0 && !line.empty(); --damage) {
      const std::size_t at = random() % line.size();
      if (random() % 2 == 0)
        line.erase(at, 1 + random() % 3);
      else
        line[at] = static_cast<char>(random());
    }
    if (std::holds_alternative<ResendReply>(parse_reply(line))) ++resends;
  }
  CHECK(resends > 100);  // enough of it was still understood to have gone deep
}
