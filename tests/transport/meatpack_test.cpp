#include "transport/protocol/meatpack.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/transport/sample_print.h"
#include "transport/emulator/print_on_emulator.h"
#include "transport/protocol/command_class.h"
#include "transport/protocol/line_acceptance.h"
#include "transport/protocol/line_assembler.h"
#include "transport/protocol/line_form.h"
#include "transport/protocol/line_framing.h"
#include "transport/protocol/meatpack_decoder.h"
#include "transport/protocol/packable_form.h"
#include "transport/protocol/packed_line.h"

// MeatPack both ways, against bytes that a real Marlin 2.1.2.1 took and against each other.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;

std::string hex(const std::string& bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02X} ", static_cast<unsigned char>(byte));
  if (!text.empty()) text.pop_back();
  return text;
}

std::string unpack(MeatPackDecoder& decoder, const std::string& bytes) {
  std::string text;
  for (const char byte : bytes) text += decoder.push(byte).text;
  return text;
}

MeatPackDecoder ready(bool no_spaces) {
  MeatPackDecoder decoder;
  CHECK(unpack(decoder, meatpack::start(no_spaces)).empty());
  return decoder;
}

/// What the firmware makes of packed `bytes` when line `number` is next: lines that it would run, without
/// their sums.
std::vector<std::string> run_by_firmware(const std::string& bytes, LineNumber number) {
  MeatPackDecoder decoder = ready(true);
  LineAssembler assembler(kMaxLineBytes);
  LineAcceptance acceptance(true);
  acceptance.set_last_line(number - 1);
  std::vector<std::string> ran;
  for (const char character : unpack(decoder, bytes)) {
    const auto line = assembler.push(character);
    if (line && acceptance.judge(*line) == Verdict::kAccepted)
      ran.push_back(line->substr(0, line->rfind('*')));
  }
  return ran;
}

/// A line with a number or without one.
bool is_move(const std::string& line) {
  return line.starts_with('N') || classify(line) == CommandClass::kMotion;
}

/// Whole lines of whatever a wire may carry, G-code characters for the most part.
std::string random_lines(std::mt19937_64& random) {
  constexpr std::string_view kFrequent = "0123456789. GXYEFNM*-";
  std::string text;
  for (std::size_t line = 0; line < 1 + random() % 4; ++line) {
    for (std::size_t length = random() % 30; length > 0; --length) {
      text += random() % 8 == 0 ? static_cast<char>(' ' + random() % 200)
                                : kFrequent[random() % kFrequent.size()];
      if (text.back() == meatpack::kSignal) text.back() = 'Q';
    }
    text += '\n';
  }
  return text;
}

}  // namespace

TEST_CASE("meatpack: the bytes that Marlin was seen to take") {
  CHECK(hex(meatpack::pack("M114\n", false)) == "1F 4D 41 CC");
  // Marlin was given N1 and the two zeros in one byte each, 1F and 00; here they keep apart.
  CHECK(hex(meatpack::pack("N1 G1 X5 Y6 F3000*78\n", false)) ==
        "FF 4E 31 DB B1 5E FB 59 B6 3F 46 F0 30 F0 2A 87 CC");
  MeatPackDecoder decoder = ready(false);
  CHECK(unpack(decoder, "\x1F\x4E\xDB\xB1\x5E\xFB\x59\xB6\x3F\x46" + std::string(1, '\0') +
                            "\xF0\x2A\x87\xCC") == "N1 G1 X5 Y6 F3000*78\n");
  CHECK(hex(meatpack::pack("G1X7.5Y3E0.1\n", true)) == "1D 7E 5A 3F 59 0B 1A CC");
  CHECK(hex(meatpack::start(true)) == "FF FF F9 FF FF F7 FF FF FB");
}

TEST_CASE("meatpack: what is packed comes out again, whatever it is and however it is cut") {
  std::mt19937_64 random(20261122);
  for (int round = 0; round < 3000; ++round) {
    const bool no_spaces = round % 2 == 0;
    const std::string lines = random_lines(random);
    MeatPackDecoder decoder = ready(no_spaces);
    const std::string packed = meatpack::pack(lines, no_spaces);
    INFO("round " << round << ": " << lines);
    CHECK(unpack(decoder, packed) == lines);
    // Every line begins anew: packed one by one they are the same bytes, and control commands may come in
    // between.
    std::string one_by_one;
    for (std::size_t begin = 0; begin < lines.size();) {
      const std::size_t end = lines.find('\n', begin) + 1;
      one_by_one += meatpack::pack(lines.substr(begin, end - begin), no_spaces);
      begin = end;
    }
    CHECK(one_by_one == packed);
    std::string with_question = packed;
    with_question.insert(random() % (packed.size() + 1), meatpack::control(meatpack::kQuery));
    CHECK(unpack(decoder, with_question) == lines);
  }
}

TEST_CASE("meatpack: whatever bit of a packed line is turned over, and whatever byte is lost, is noticed") {
  std::mt19937_64 random(3);
  const auto number = [&random](int range) {
    const auto value = static_cast<double>(random() % 100000) / 99999.0 * 2 - 1;
    return fmt::format("{:.{}f}", value * range, random() % 5);
  };
  int damages = 0;
  int unnoticed = 0;
  for (int round = 0; round < 300; ++round) {
    const LineNumber line_number = static_cast<LineNumber>(1 + random() % (random() % 2 == 0 ? 90 : 99000));
    std::string command = fmt::format("G1X{}Y{}E{}", number(300), number(300), number(5));
    if (round % 5 == 0)
      command = fmt::format("G2X{}Y{}I{}J{}E{}", number(300), number(300), number(50), number(50), number(2));
    if (round % 11 == 0) command = fmt::format("G1E{}F{}", number(6), 100 + random() % 9000);
    if (round % 13 == 0) command = fmt::format("M{}S{}", 100 + random() % 150, random() % 256);
    const std::string line = frame_line(line_number, packable_form(wire_form(command, {}), 1), {false, true});
    const auto packed = packed_line(line, line_number, true);
    INFO(line);
    REQUIRE(packed);
    // (A point may stand behind the sum.)
    MeatPackDecoder fresh = ready(true);
    CHECK(unpack(fresh, *packed).starts_with(line.substr(0, line.size() - 1)));
    for (std::size_t at = 0; at < packed->size(); ++at) {
      for (int bit = 0; bit <= 8; ++bit) {
        std::string damaged = *packed;
        if (bit == 8) {
          damaged.erase(at, 1);
        } else {
          damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
        }
        // The line behind it comes whole.
        damaged += meatpack::pack(frame_line(line_number + 1, "G1X5", {false, true}), true);
        ++damages;
        const std::vector<std::string> ran = run_by_firmware(damaged, line_number);
        const bool fine = std::all_of(ran.begin(), ran.end(), [&](const std::string& command_run) {
          return command_run == line.substr(0, line.rfind('*')) ||
                 command_run ==
                     fmt::format(
                         "{}",
                         frame_line(line_number + 1, "G1X5", {false, true}).substr(0, command_run.size())) ||
                 !is_move(command_run);
        });
        if (!fine) {
          ++unnoticed;
          WARN(line << at << ", bit " << bit << ": " << ran.front());
        }
      }
    }
  }
  CHECK(damages > 30000);
  CHECK(unnoticed == 0);
}

TEST_CASE("meatpack: what no form can show is a byte too many that stands for two equal characters") {
  const std::string line = frame_line(140, "G1X105.306Y114.492E.00608", {false, true});
  const auto packed = packed_line(line, 140, true);
  REQUIRE(packed);
  int seen = 0;
  int unnoticed = 0;
  for (std::size_t at = 0; at <= packed->size(); ++at) {
    for (int value = 0; value < 256; ++value) {
      std::string damaged = *packed;
      damaged.insert(at, 1, static_cast<char>(value));
      for (const std::string& ran : run_by_firmware(damaged, 140)) {
        if (ran == line.substr(0, line.rfind('*')) || !is_move(ran)) continue;
        ++unnoticed;
        const bool equal_pair = (value & 0xF) == value >> 4;
        const bool becomes_move = at == 0 && ran.starts_with('G');
        seen += equal_pair || becomes_move ? 1 : 0;
      }
    }
  }
  // One in thirty, about: packing is for links that put nothing in.
  CHECK(unnoticed > 0);
  CHECK(30 * unnoticed < 2 * 256 * static_cast<int>(packed->size()));
  CHECK(100 * seen >= 85 * unnoticed);
}

TEST_CASE(
    "meatpack: the decoder answers control commands, and keeps its table through a reset as Marlin does") {
  MeatPackDecoder decoder;
  const auto answer = [&decoder](char code) {
    std::string reply;
    for (const char byte : meatpack::control(code)) reply += decoder.push(byte).reply;
    return reply;
  };
  CHECK(answer(meatpack::kQuery) == "[MP] PV01 OFF ESP\n");
  CHECK(answer(meatpack::kNoSpaces) == "[MP] PV01 OFF NSP\n");
  CHECK(answer(meatpack::kEnable) == "[MP] PV01 ON NSP\n");
  CHECK(answer(meatpack::kResetAll) == "[MP] PV01 OFF ESP\n");
  CHECK(answer(meatpack::kEnable) == "[MP] PV01 ON ESP\n");
  CHECK(unpack(decoder, meatpack::pack("M117 A B\n", false)) == "M117EAEB\n");
  CHECK(answer(meatpack::kWithSpaces) == "[MP] PV01 ON ESP\n");
  CHECK(unpack(decoder, meatpack::pack("M117 A B\n", false)) == "M117 A B\n");
}

TEST_CASE("meatpack: the start sequence recovers from every state that noise can leave") {
  std::mt19937_64 random(7);
  for (int round = 0; round < 3000; ++round) {
    MeatPackDecoder decoder = ready(true);
    std::string noise;
    for (std::size_t length = random() % 12; length > 0; --length)
      noise += random() % 4 == 0 ? meatpack::kSignal : static_cast<char>(random() % 256);
    unpack(decoder, noise);
    INFO("round " << round << ": " << hex(noise));
    unpack(decoder, meatpack::start(true));
    CHECK(unpack(decoder, meatpack::pack("N1G1X5*36\n", true)) == "N1G1X5*36\n");
  }
}

TEST_CASE("meatpack: no cut between two bytes leaves a line that begins with G") {
  // The tail of a line that the firmware's flush has cut runs as a command of its own.
  for (const LineNumber number : {1, 12, 123, 1234, 99999, 123456}) {
    const std::string line =
        frame_line(number, wire_form("G1 X57.125 Y103.4 E0.03125 F1800", {}), {false, true});
    const std::string packed = meatpack::pack(line, true);
    for (std::size_t cut = 1; cut < packed.size(); ++cut) {
      MeatPackDecoder decoder = ready(true);
      unpack(decoder, packed.substr(0, cut));
      CHECK_FALSE(unpack(decoder, packed.substr(cut)).starts_with('G'));
    }
  }
}

TEST_CASE("meatpack: a print packs its lines where the printer offers it, and deposits the same") {
  const auto lines = lamina::tests::sample_print(200);
  EmulatedPrintOptions options;
  options.emulator.record = RecordDetail::kBeads;
  options.time_limit = 2h;
  const EmulatedPrint plain = print_on_emulator(lamina::tests::source_of(lines), options);
  options.emulator.features.meatpack = true;
  options.job.engine.meatpack_after = 0;
  const EmulatedPrint packed = print_on_emulator(lamina::tests::source_of(lines), options);
  REQUIRE(packed.result.outcome == JobPhase::kCompleted);
  CHECK(packed.result.progress.wire.resends == 0);
  CHECK(packed.result.progress.wire.probes == 0);
  CHECK(packed.report.unknown_commands == 0);
  CHECK(packed.beads == plain.beads);
  CHECK(100 * packed.result.progress.wire.bytes_sent < 72 * plain.result.progress.wire.bytes_sent);
  // Only when the link has shown that it is good.
  options.job.engine.meatpack_after = 3000;
  const EmulatedPrint later = print_on_emulator(lamina::tests::source_of(lines), options);
  CHECK(later.beads == plain.beads);
  CHECK(later.result.progress.wire.bytes_sent > packed.result.progress.wire.bytes_sent + 800);
  CHECK(later.result.progress.wire.bytes_sent < plain.result.progress.wire.bytes_sent - 800);
  options.job.engine.meatpack_after = 0;
  // And not where it is not wanted, nor where lines go one at a time.
  options.job.engine.window.lines = 1;
  const EmulatedPrint single = print_on_emulator(lamina::tests::source_of(lines), options);
  CHECK(single.result.progress.wire.bytes_sent == plain.result.progress.wire.bytes_sent);
  options.job.engine.window.lines = 3;
  options.job.engine.meatpack = false;
  const EmulatedPrint unpacked = print_on_emulator(lamina::tests::source_of(lines), options);
  CHECK(unpacked.result.progress.wire.bytes_sent == plain.result.progress.wire.bytes_sent);
}

TEST_CASE("meatpack: a link that has damaged a packed line gets them plain from there on") {
  EngineOptions options;
  options.meatpack_after = 0;
  ProtocolEngine engine(options);
  Instant now{};
  const auto hear = [&](const std::string& bytes) {
    engine.receive(bytes, now);
    return engine.take_output();
  };
  const auto wait = [&](Duration time) {
    now += time;
    engine.tick(now);
    return engine.take_output();
  };
  engine.connect(now);
  hear("start\n");
  wait(100ms);
  hear("ok\n");
  wait(100ms);
  CHECK(hear("Cap:MEATPACK:1\n") == meatpack::start(true));
  hear("[MP] PV01 ON NSP\n");
  REQUIRE(engine.packs());
  engine.submit("G1 X1", LineOrigin::kJob);
  CHECK(wait(1ms) == meatpack::pack(frame_line(1, "G1X1", {false, true}), true));
  hear("Error:checksum mismatch, Last Line: 0\nResend: 1\nok\n");
  CHECK_FALSE(engine.packs());
  const std::string off = meatpack::control(meatpack::kResetAll);
  CHECK(wait(50ms) == off + frame_line(1, "G1X1", {false, false}));
  // It may have missed that: whenever something is odd it is told again.
  CHECK(wait(30s) == off + "\n");
  CHECK(wait(1s).starts_with(off));
}

TEST_CASE("meatpack: over a bad link no line is lost or run twice") {
  const auto lines = lamina::tests::sample_print(150);
  EmulatedPrintOptions options;
  options.emulator.record = RecordDetail::kBeads;
  options.job.engine.meatpack_after = 0;
  options.time_limit = 2h;
  const EmulatedPrint clean = print_on_emulator(lamina::tests::source_of(lines), options);
  options.emulator.features.meatpack = true;
  options.emulator.serial.overflow = Overflow::kLose;
  std::int64_t resends = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    for (WireOptions* wire : {&options.to_printer, &options.to_host}) {
      wire->baud = 115200;
      wire->faults.flip = wire->faults.drop = 1e-3;
      wire->faults.spacing = 96;
      wire->faults.seed = seed + (wire == &options.to_host ? 1000 : 0);
    }
    const EmulatedPrint print = print_on_emulator(lamina::tests::source_of(lines), options);
    INFO("seed " << seed << ": " << print.result.failure);
    REQUIRE(print.result.outcome == JobPhase::kCompleted);
    CHECK(print.beads == clean.beads);
    resends += print.result.progress.wire.resends;
  }
  CHECK(resends > 30);
}
