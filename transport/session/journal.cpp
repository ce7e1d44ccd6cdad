#include "transport/session/journal.h"

#include <array>
#include <charconv>
#include <utility>

namespace lamina::transport {

namespace {

constexpr std::string_view kVersion = "lamina-journal 1";

/// Shortest text that reads back as the same number.
template <typename Number>
std::string text_of(Number number) {
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return {digits.data(), end};
}

[[noreturn]] void damaged(std::string_view what) {
  throw JournalError("the journal is damaged at \"" + std::string(what.substr(0, 40)) + "\"");
}

template <typename Number>
Number number_of(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) damaged(text);
  return number;
}

/// Takes the first word off `text`.
std::string_view take_word(std::string_view& text) {
  const std::size_t blank = text.find(' ');
  const std::string_view word = text.substr(0, blank);
  text.remove_prefix(blank == std::string_view::npos ? text.size() : blank + 1);
  return word;
}

/// A name in one line.
std::string one_line(std::string text) {
  for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;
  return text;
}

constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

std::string encode(const MachineState& state) {
  std::string text;
  const auto add = [&text](const std::string& key, auto value) { text += ' ' + key + ':' + text_of(value); };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (state.position[axis]) add(std::string(kAxes[axis]), *state.position[axis]);
    if (state.homed[axis]) add("home", static_cast<int>(axis));
  }
  add("e", state.e);
  add("fed", state.e_total);
  add("peak", state.e_peak);
  if (state.relative) add("relative", 1);
  if (state.extruder_relative) add("extruder_relative", 1);
  if (state.inches) add("inches", 1);
  if (state.feedrate) add("f", *state.feedrate);
  add("feed", state.feed_percent);
  add("flow", state.flow_percent);
  add("tool", state.tool);
  for (const auto& [tool, target] : state.nozzles) add("nozzle." + text_of(tool), target);
  add("bed", state.bed);
  add("chamber", state.chamber);
  for (const auto& [fan, speed] : state.fans) add("fan." + text_of(fan), speed);
  for (const auto& [code, values] : state.settings) {
    for (const auto& [letter, value] : values) add(code + '.' + letter, value);
  }
  return text.substr(1);
}

void decode_entry(MachineState& state, std::string_view key, std::string_view value) {
  const auto real = [&] { return number_of<double>(value); };
  const std::size_t dot = key.find('.');
  const std::string_view group = key.substr(0, dot);
  if (dot != std::string_view::npos) {
    const std::string_view member = key.substr(dot + 1);
    if (group == "nozzle") {
      state.nozzles[number_of<int>(member)] = real();
    } else if (group == "fan") {
      state.fans[number_of<int>(member)] = number_of<int>(value);
    } else if (member.size() == 1) {
      state.settings[std::string(group)][member.front()] = real();
    } else {
      damaged(key);
    }
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (key == kAxes[axis]) state.position[axis] = real();
  }
  if (key == "home") state.homed.at(number_of<std::size_t>(value) % 3) = true;
  if (key == "e") state.e = real();
  if (key == "fed") state.e_total = real();
  if (key == "peak") state.e_peak = real();
  if (key == "relative") state.relative = true;
  if (key == "extruder_relative") state.extruder_relative = true;
  if (key == "inches") state.inches = true;
  if (key == "f") state.feedrate = real();
  if (key == "feed") state.feed_percent = real();
  if (key == "flow") state.flow_percent = real();
  if (key == "tool") state.tool = number_of<int>(value);
  if (key == "bed") state.bed = real();
  if (key == "chamber") state.chamber = real();
}

MachineState decode_state(std::string_view text) {
  MachineState state;
  while (!text.empty()) {
    const std::string_view entry = take_word(text);
    const std::size_t colon = entry.find(':');
    if (colon == std::string_view::npos) damaged(entry);
    decode_entry(state, entry.substr(0, colon), entry.substr(colon + 1));
  }
  return state;
}

char origin_letter(LineOrigin origin) {
  switch (origin) {
    case LineOrigin::kJob:
      return 'J';
    case LineOrigin::kInjected:
      return 'I';
    case LineOrigin::kProtocol:
      break;
  }
  return 'P';
}

JournalLine decode_line(std::string_view text) {
  JournalLine line;
  const std::string_view origin = take_word(text);
  if (origin == "J") {
    line.mark.line = number_of<std::int64_t>(take_word(text));
    line.mark.part = number_of<int>(take_word(text));
    line.mark.last = take_word(text) == "1";
  } else if (origin == "I" || origin == "P") {
    line.origin = origin == "I" ? LineOrigin::kInjected : LineOrigin::kProtocol;
  } else {
    damaged(origin);
  }
  line.command = text;
  return line;
}

void decode_entry(JournalRecord& record, std::string_view key, std::string_view value) {
  if (key == "source") record.source = value;
  if (key == "size") record.source_size = number_of<std::int64_t>(value);
  if (key == "port") record.port = value;
  if (key == "baud") record.baud = number_of<int>(value);
  if (key == "ended") record.ended = value;
  if (key == "settled") record.settled = number_of<LineNumber>(value);
  if (key == "acknowledged") record.acknowledged = number_of<LineNumber>(value);
  if (key == "lines") record.position.lines = number_of<std::int64_t>(value);
  if (key == "bytes") record.position.bytes = number_of<std::int64_t>(value);
  if (key == "hash") record.position.hash = number_of<std::uint64_t>(value);
  if (key == "parts") record.parts = number_of<int>(value);
  if (key == "layer") record.layer = number_of<std::int64_t>(value);
  if (key == "printer") record.printer = decode_state(value);
  if (key == "parked_from") record.parked_from = decode_state(value);
  if (key == "file") record.filter.file = decode_state(value);
  if (key == "object") record.filter.object = value;
  if (key == "arcs") record.dialect.arcs = value == "1";
  if (key == "bezier") record.dialect.bezier = value == "1";
  if (key == "progress") record.dialect.progress = value == "1";
  if (key == "objects") record.dialect.objects = value == "1";
  if (key == "lacking") record.dialect.lacking.emplace(value);
  if (key == "other_plane") record.filter.other_plane = value == "1";
  if (key == "skipped") record.filter.skipped.emplace(value);
  if (key == "skipping_from") record.filter.skipping_from = decode_state(value);
  if (key == "line") record.lines.push_back(decode_line(value));
}

}  // namespace

std::string encode(const JournalRecord& record) {
  std::string text(kVersion);
  text += '\n';
  const auto add = [&text](std::string_view key, const std::string& value) {
    text.append(key).append(1, ' ').append(value).append(1, '\n');
  };
  add("source", one_line(record.source));
  add("size", text_of(record.source_size));
  add("port", one_line(record.port));
  add("baud", text_of(record.baud));
  if (!record.ended.empty()) add("ended", one_line(record.ended));
  add("settled", text_of(record.settled));
  add("acknowledged", text_of(record.acknowledged));
  add("lines", text_of(record.position.lines));
  add("bytes", text_of(record.position.bytes));
  add("hash", text_of(record.position.hash));
  add("parts", text_of(record.parts));
  add("layer", text_of(record.layer));
  add("printer", encode(record.printer));
  if (record.parked_from) add("parked_from", encode(*record.parked_from));
  add("file", encode(record.filter.file));
  if (record.filter.object) add("object", one_line(*record.filter.object));
  add("other_plane", record.filter.other_plane ? "1" : "0");
  add("arcs", record.dialect.arcs ? "1" : "0");
  add("bezier", record.dialect.bezier ? "1" : "0");
  add("progress", record.dialect.progress ? "1" : "0");
  add("objects", record.dialect.objects ? "1" : "0");
  for (const std::string& code : record.dialect.lacking) add("lacking", code);
  for (const std::string& object : record.filter.skipped) add("skipped", one_line(object));
  if (record.filter.skipping_from) add("skipping_from", encode(*record.filter.skipping_from));
  for (const JournalLine& line : record.lines) {
    std::string value(1, origin_letter(line.origin));
    value += ' ';
    if (line.origin == LineOrigin::kJob) {
      value += text_of(line.mark.line) + ' ' + text_of(line.mark.part) + (line.mark.last ? " 1 " : " 0 ");
    }
    add("line", value + line.command);
  }
  return text;
}

JournalRecord decode(std::string_view text) {
  JournalRecord record;
  bool first = true;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) damaged(text);
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (std::exchange(first, false)) {
      if (line != kVersion) throw JournalError("the journal was written by another version of lamina");
      continue;
    }
    const std::string_view key = take_word(line);
    decode_entry(record, key, line);
  }
  if (first) damaged(text);
  return record;
}

}  // namespace lamina::transport
