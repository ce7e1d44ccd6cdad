#include <cmath>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_targets.h"
#include "transport/emulator/emulator.h"
#include "transport/emulator/gcode_command.h"
#include "transport/protocol/line_form.h"
#include "transport/protocol/line_framing.h"
#include "transport/protocol/line_stripper.h"
#include "transport/protocol/meatpack.h"
#include "transport/protocol/meatpack_decoder.h"
#include "transport/protocol/packable_form.h"
#include "transport/protocol/reply.h"

namespace lamina::fuzz {

using namespace transport;

namespace {

unsigned char byte_at(std::string_view input, std::size_t at) {
  return at < input.size() ? static_cast<unsigned char>(input[at]) : 0;
}

std::string unpack(MeatPackDecoder& decoder, std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += decoder.push(byte).text;
  return text;
}

}  // namespace

void replies(std::string_view input) {
  ReplyLines whole;
  const std::vector<std::string> lines = whole.push(input);
  ReplyLines in_pieces;
  std::vector<std::string> pieces;
  for (const char byte : input) {
    for (std::string& line : in_pieces.push({&byte, 1})) pieces.push_back(std::move(line));
  }
  require(lines == pieces, "reply lines depend on how the bytes arrive");
  for (const std::string& line : lines) {
    require(!line.empty() && line.size() <= ReplyLines::kMaxReplyBytes, "a reply line of impossible length");
    const Reply reply = parse_reply(line);
    if (const auto* temperatures = std::get_if<TemperatureReport>(&reply))
      require(!temperatures->heaters.empty(), "a temperature report without heaters");
    if (const auto* ok = std::get_if<OkReply>(&reply))
      require(ok->glued || line.find_first_of("oO") != std::string::npos, "an ok without an o");
  }
}

void printer_lines(std::string_view input) {
  EmulatorOptions options;
  const unsigned char how = byte_at(input, 0);
  FirmwareFeatures& features = options.features;
  features.advanced_ok = (how & 1U) != 0;
  features.emergency_parser = (how & 2U) != 0;
  features.meatpack = (how & 4U) != 0;
  features.host_actions = (how & 8U) != 0;
  features.sd_card = features.firmware_retraction = features.leveling = (how & 16U) != 0;
  features.filament_change = features.cancel_objects = features.bezier = (how & 32U) != 0;
  options.serial.overflow = (how & 64U) != 0 ? Overflow::kLose : Overflow::kHoldBack;
  if ((how & 128U) != 0) {
    options.thermal.room = 200;
    options.motion.jerk = PerAxis{8, 8, 0.4, 5};
    options.serial.refusal_time = std::chrono::milliseconds(3);
  }
  Emulator printer(options);
  Instant now{};
  std::size_t said = 0;
  std::size_t at = 1;
  while (at < input.size()) {
    const std::size_t length = 1 + byte_at(input, at) % 40U;
    const auto pause = std::chrono::milliseconds(byte_at(input, at + 1));
    at += 2;
    const std::string_view piece = input.substr(std::min(at, input.size()), length);
    at += length;
    const std::size_t taken = printer.receive(piece, now);
    require(taken <= piece.size(), "more taken than offered");
    require(options.serial.overflow == Overflow::kHoldBack || taken == piece.size(),
            "a lossy line held back");
    now += pause;
    printer.advance(now);
    const auto next = printer.next_event();
    require(!next || *next > now, "something is due and was not done");
    said += printer.take_output().size();
  }
  now += std::chrono::seconds(3);
  printer.advance(now);
  const PrintReport& report = printer.report();
  require(std::isfinite(report.filament) && report.filament >= 0, "an impossible amount of filament");
  require(report.moves >= report.beads, "more beads than moves");
  require(said < 200 * 1024 + 2000 * input.size(), "much ado about nothing");
}

void meatpack_round_trip(std::string_view input) {
  const bool no_spaces = byte_at(input, 0) % 2 == 0;
  std::string text(input.substr(std::min<std::size_t>(1, input.size())));
  for (char& c : text) {
    if (c == meatpack::kSignal) c = '!';
  }
  text += '\n';
  MeatPackDecoder decoder;
  unpack(decoder, meatpack::start(no_spaces));
  require(decoder.enabled(), "the start sequence does not start");
  require(unpack(decoder, meatpack::pack(text, no_spaces)) == text, "packed and unpacked is not the same");

  // And a command in its packable form reads the same.
  const std::string command = wire_form(strip_line(input.substr(0, input.find('\n'))), {});
  const std::string packable = packable_form(command, 1);
  const GcodeCommand expected = parse_gcode_command(command);
  const GcodeCommand read = parse_gcode_command(packable);
  require(read.letter == expected.letter && read.code == expected.code && read.values == expected.values,
          "zeros for packing changed a value");
}

void meatpack_decoder(std::string_view input) {
  MeatPackDecoder decoder;
  for (const char byte : input) {
    const MeatPackDecoder::Decoded decoded = decoder.push(byte);
    require(decoded.text.size() <= 4, "a byte that makes many characters");
    require(decoded.reply.empty() || decoded.reply.starts_with("[MP] PV01 "), "a strange answer");
  }
  unpack(decoder, meatpack::start(true));
  require(unpack(decoder, meatpack::pack("N1G1X5*36\n", true)) == "N1G1X5*36\n",
          "the start sequence does not recover");
}

}  // namespace lamina::fuzz
