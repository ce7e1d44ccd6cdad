#include <catch2/catch.hpp>

#include "tests/transport/sample_print.h"
#include "transport/emulator/emulator.h"
#include "transport/emulator/wire.h"
#include "transport/protocol/line_form.h"
#include "transport/protocol/line_stripper.h"
#include "transport/session/card_protocol.h"

using namespace lamina::transport;
using lamina::tests::sample_print;
using lamina::tests::source_of;

namespace {

/// A printer with a card, and sessions with it in simulated time.
class CardRig {
 public:
  CardRig() : CardRig(WireOptions{}, WireOptions{}) {}
  CardRig(const WireOptions& to_printer, const WireOptions& to_host)
      : emulator_(with_card(), Instant{}), to_printer_(to_printer), to_host_(to_host) {
    emulator_.take_output();
  }

  std::vector<CommandAnswer> ask(const std::vector<std::string>& commands, std::size_t window = 1) {
    EngineOptions options;
    options.window.lines = window;
    CommandSession session(source_of(commands), options,
                           [](const CommandAnswer& answer) { return !card_complaint(answer); });
    std::vector<CommandAnswer> answers;
    session.start(now_);
    for (int step = 0; step < 5'000'000 && !session.finished(); ++step) {
      emulator_.advance(now_);
      const std::string arrived = to_printer_.take_arrived(now_);
      to_printer_.put_back(std::string_view(arrived).substr(emulator_.receive(arrived, now_)), now_);
      to_host_.send(emulator_.take_output(), now_);
      session.receive(to_host_.take_arrived(now_), now_);
      session.tick(now_);
      to_printer_.send(session.take_output(), now_);
      for (CommandAnswer& answer : session.take_answers()) answers.push_back(std::move(answer));
      std::optional<Instant> next = session.deadline();
      for (const auto& other :
           {emulator_.next_event(), to_printer_.next_arrival(), to_host_.next_arrival()}) {
        if (other && (!next || *other < *next)) next = other;
      }
      if (!next) break;
      now_ = std::max(now_, *next);
    }
    INFO(session.failure());
    CHECK(session.finished());
    CHECK(session.failure().empty());
    return answers;
  }

  void wait(Duration span) {
    now_ += span;
    emulator_.advance(now_);
  }
  Emulator& printer() { return emulator_; }

 private:
  static EmulatorOptions with_card() {
    EmulatorOptions options;
    options.features.sd_card = true;
    options.record = RecordDetail::kBeads;
    options.thermal.hotend = {200, 160, 8};
    options.thermal.bed = {200, 400, 4};
    return options;
  }

  Emulator emulator_;
  Wire to_printer_;
  Wire to_host_;
  Instant now_{};
};

}  // namespace

TEST_CASE("card: a file is uploaded, listed, printed as from the host, and deleted") {
  const auto lines = sample_print(80);
  CardRig rig;
  CHECK(card_files(rig.ask({"M21", "M20"}).back())->empty());
  std::vector<std::string> upload{"M28 SAMPLE.GCO"};
  for (const std::string& line : lines) {
    if (!line.starts_with(';')) upload.push_back(line);
  }
  upload.emplace_back("M29");
  for (const CommandAnswer& answer : rig.ask(upload, 3)) CHECK_FALSE(card_complaint(answer));
  CHECK(rig.printer().report().beads == 0);

  const auto files = card_files(rig.ask({"M20"}).back());
  REQUIRE(files);
  REQUIRE(files->size() == 1);
  CHECK(files->front().name == "SAMPLE.GCO");
  CHECK(files->front().size > 1000);

  CHECK_FALSE(card_progress(rig.ask({"M27"}).back()));
  rig.ask({"M23 SAMPLE.GCO", "M24"});
  const auto progress = card_progress(rig.ask({"M27"}).back());
  REQUIRE(progress);
  CHECK(progress->size == files->front().size);
  rig.wait(std::chrono::minutes(20));
  CHECK(rig.printer().report().beads == 80);
  CHECK(rig.printer().report().cold_extrusions == 0);

  CHECK_FALSE(card_complaint(rig.ask({"M30 SAMPLE.GCO"}).back()));
  CHECK(card_files(rig.ask({"M20"}).back())->empty());
}

TEST_CASE("card: an upload over a noisy link writes the file and nothing else") {
  std::vector<std::string> commands;
  for (const std::string& line : sample_print(80)) {
    if (const std::string command = strip_line(line); !command.empty()) commands.push_back(command);
  }
  std::string expected;
  for (const std::string& command : commands) expected += wire_form(command, LineForm{}) + '\n';
  std::vector<std::string> upload{"M28 SAMPLE.GCO"};
  upload.insert(upload.end(), commands.begin(), commands.end());
  upload.emplace_back("M29");

  std::int64_t refused = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    WireOptions wires[2];
    for (WireOptions& wire : wires) {
      wire.baud = 115200;
      wire.faults.flip = wire.faults.drop = wire.faults.insert = 3e-4;
      wire.faults.spacing = 96;
      wire.faults.seed = seed + (&wire == wires ? 0 : 1000);
    }
    CardRig rig(wires[0], wires[1]);
    rig.ask(upload, seed % 2 == 0 ? 1 : 3);
    INFO("seed " << seed);
    const auto& files = rig.printer().card().files();
    REQUIRE(files.contains("SAMPLE.GCO"));
    CHECK(files.at("SAMPLE.GCO") == expected);
    refused += rig.printer().report().refused_lines;
  }
  CHECK(refused > 20);
}

TEST_CASE("card: what cannot be opened is neither printed nor written, and nothing behind it is sent") {
  CardRig rig;
  const auto answers = rig.ask({"M23 NOTHERE.GCO", "M24"});
  REQUIRE(answers.size() == 1);
  CHECK(card_complaint(answers.front())->find("open failed") != std::string::npos);
  CHECK(card_complaint(rig.ask({"M30 NOTHERE.GCO"}).back()));
}

TEST_CASE("card: answers as firmwares give them") {
  const CommandAnswer list{"M20",
                           {"Begin file list", "PART.GCO 1234", "LONG~1.GCO 99 0x5a6b1234 long name.gcode",
                            "ODD.GCO", "End file list"}};
  const auto files = card_files(list);
  REQUIRE(files);
  REQUIRE(files->size() == 3);
  CHECK((*files)[0].size == 1234);
  CHECK((*files)[1].long_name == "long name.gcode");
  CHECK((*files)[2].size == -1);
  CHECK_FALSE(card_files({"M20", {"echo:No media"}}));
  CHECK(card_complaint({"M20", {"echo:No media"}}));
  CHECK(card_progress({"M27", {"SD printing byte 12/345"}})->position == 12);
  CHECK_FALSE(card_progress({"M27", {"Not SD printing"}}));
  CHECK_FALSE(card_progress({"M27", {"SD printing byte 12"}}));
  CHECK(card_name("/home/me/my part, v2.gcode") == "MYPARTV2.GCO");
  CHECK(card_name("a_very_long_name.g") == "A_VERY_L.GCO");
  CHECK(card_name("...") == "PART.GCO");
}
