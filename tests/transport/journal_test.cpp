#include <filesystem>
#include <fstream>
#include <random>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "transport/session/execution_log.h"
#include "transport/session/journal_file.h"

using namespace lamina::transport;
namespace fs = std::filesystem;

namespace {

MachineState random_state(std::mt19937& random) {
  std::uniform_real_distribution<double> length(-1000, 1000);
  const auto coin = [&] { return random() % 2 == 0; };
  MachineState state;
  for (auto& place : state.position) {
    if (coin()) place = length(random) / 3;
  }
  state.e = length(random) / 7;
  state.e_total = 1e6 + length(random) / 11;
  state.e_peak = state.e_total + 1;
  state.relative = coin();
  state.extruder_relative = coin();
  state.inches = coin();
  state.homed = {coin(), coin(), coin()};
  if (coin()) state.feedrate = length(random);
  state.feed_percent = 100 + length(random) / 100;
  state.tool = static_cast<int>(random() % 4);
  state.nozzles[state.tool] = 210.5;
  state.bed = 60;
  state.fans[static_cast<int>(random() % 3)] = 77;
  state.settings["M204"]['P'] = length(random);
  return state;
}

JournalRecord random_record(std::mt19937& random) {
  JournalRecord record;
  record.source = "/home/some one/part.gcode";
  record.source_size = static_cast<std::int64_t>(random());
  record.port = "/dev/ttyUSB0";
  record.baud = 250000;
  record.ended = "cancelled";
  record.settled = static_cast<LineNumber>(random() % 100000);
  record.acknowledged = record.settled + 1;
  record.printer = random_state(random);
  record.position = {1234, 56789, random()};
  record.parts = 3;
  record.layer = 17;
  record.filter.file = random_state(random);
  record.filter.object = "box id:0 copy 0";
  record.filter.skipped = {"a b", "c"};
  record.filter.other_plane = true;
  record.filter.skipping_from = random_state(random);
  record.dialect.arcs = false;
  record.dialect.lacking = {"M73", "M486"};
  record.parked_from = random_state(random);
  SourceMark mark;
  mark.line = 77;
  mark.part = 2;
  mark.last = false;
  record.lines = {{"G1 X5 Y6 E.5", LineOrigin::kJob, mark},
                  {"M105", LineOrigin::kInjected, {}},
                  {"M400", LineOrigin::kProtocol, {}}};
  return record;
}

void check_equal(const JournalRecord& a, const JournalRecord& b) {
  CHECK(a.source == b.source);
  CHECK(a.source_size == b.source_size);
  CHECK(a.port == b.port);
  CHECK(a.baud == b.baud);
  CHECK(a.ended == b.ended);
  CHECK(a.settled == b.settled);
  CHECK(a.acknowledged == b.acknowledged);
  CHECK(a.printer == b.printer);
  CHECK(a.position == b.position);
  CHECK(a.parts == b.parts);
  CHECK(a.layer == b.layer);
  CHECK(a.filter == b.filter);
  CHECK(a.dialect == b.dialect);
  CHECK(a.parked_from == b.parked_from);
  REQUIRE(a.lines.size() == b.lines.size());
  for (std::size_t i = 0; i < a.lines.size(); ++i) {
    CHECK(a.lines[i].command == b.lines[i].command);
    CHECK(a.lines[i].origin == b.lines[i].origin);
    CHECK(a.lines[i].mark.line == b.lines[i].mark.line);
    CHECK(a.lines[i].mark.part == b.lines[i].mark.part);
    CHECK(a.lines[i].mark.last == b.lines[i].mark.last);
  }
}

/// A path that is free, and empty again behind the test.
class JournalPath {
 public:
  JournalPath() : path_(fs::temp_directory_path() / ("lamina_journal_" + std::to_string(::getpid()))) {
    fs::remove(path_);
  }
  ~JournalPath() { fs::remove(path_); }
  operator const fs::path&() const { return path_; }  // NOLINT(google-explicit-constructor)

 private:
  fs::path path_;
};

void spoil(const fs::path& path, std::size_t at) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(static_cast<std::streamoff>(at));
  const char byte = static_cast<char>(file.get() ^ 1);
  file.seekp(static_cast<std::streamoff>(at));
  file.put(byte);
}

}  // namespace

TEST_CASE("journal: what is written down reads back bit for bit") {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const JournalRecord record = random_record(random);
    check_equal(decode(encode(record)), record);
  }
}

TEST_CASE("journal: damaged text is refused, whatever was damaged") {
  std::mt19937 random(4);
  const std::string text = encode(random_record(random));
  CHECK_THROWS_AS(decode(""), JournalError);
  CHECK_THROWS_AS(decode("another file\n"), JournalError);
  CHECK_THROWS_AS(decode(text.substr(0, text.size() - 1)), JournalError);
  // Any byte changed: read or refused, never a crash. The file has a hash around it.
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string changed = text;
    changed[at] = static_cast<char>(random());
    try {
      decode(changed);
    } catch (const JournalError&) {
    }
  }
}

TEST_CASE("journal file: the newest whole record wins, at whatever byte the last write was torn") {
  const JournalPath path;
  std::mt19937 random(5);
  JournalRecord first = random_record(random);
  JournalRecord second = random_record(random);
  first.layer = 1;
  second.layer = 2;
  {
    JournalFile file(path, {JournalSync::kNever, {}});
    CHECK_FALSE(file.read());
    file.write(first);
    check_equal(*file.read(), first);
    file.write(second);
    check_equal(*file.read(), second);
    CHECK_THROWS_AS(JournalFile(path), JournalError);  // one writer at a time
  }
  CHECK(fs::file_size(path) <= 2 * JournalFile::kSlotBytes);
  // The second write went into slot 0.
  const std::size_t length = encode(second).size();
  for (std::size_t at :
       {std::size_t{0}, std::size_t{19}, std::size_t{25}, std::size_t{40}, std::size_t{60}, length}) {
    spoil(path, at);
    JournalFile file(path, {JournalSync::kNever, {}});
    INFO("byte " << at);
    CHECK(file.read()->layer == 1);
    spoil(path, at);
    CHECK(file.read()->layer == 2);
  }
  JournalFile file(path, {JournalSync::kLayer, {}});
  file.write(first);
  CHECK(file.read()->layer == 1);
}

TEST_CASE("execution log: a line is settled when twenty moves behind it were acknowledged, or a wait") {
  ExecutionLog log;
  log.begin(0, {}, {}, {}, 0);
  MachineState state;
  LineNumber number = 0;
  const auto send = [&](const std::string& command) {
    SourceMark mark;
    mark.line = ++number;
    mark.after = {number, number * 10, 0};
    log.sent({number, command, LineOrigin::kJob}, mark);
  };
  send("G28");
  log.acknowledged(1);
  CHECK(log.record().settled == 1);
  send("G90");
  send("G1 X0 Y0 Z0");
  for (int i = 1; i <= 100; ++i) {
    send("G1 X" + std::to_string(i) + " E.1");
    send("M117 " + std::to_string(i));
  }
  CHECK(log.record().settled == 1);
  log.acknowledged(number);
  // Moves 81 to 100 may wait in the planner; move 80 is certain, and the message in front of move 81 is not
  // needed to be.
  const LineNumber move_81 = 3 + 2 * 80 + 1;
  CHECK(log.record().settled >= move_81 - 2);
  CHECK(log.record().settled < move_81);
  CHECK(log.record().position.lines == log.record().settled);
  CHECK(*log.record().printer.position[0] == Approx(80));
  CHECK(*log.printer().position[0] == Approx(100));
  CHECK(log.record().last() == number);
  send("M400");
  log.acknowledged(number);
  CHECK(log.record().settled == number);
  CHECK(log.record().lines.empty());
  CHECK(log.record().printer == log.printer());
}
