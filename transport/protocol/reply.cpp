#include "transport/protocol/reply.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

namespace lamina::transport {

namespace {

constexpr double kMostPower = 255;

/// Of planner and queue.
constexpr LineNumber kMostPlaces = 1000;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

bool starts_with_any_case(std::string_view text, std::string_view prefix) {
  if (text.size() < prefix.size()) return false;
  for (std::size_t i = 0; i < prefix.size(); ++i) {
    if (lower(text[i]) != lower(prefix[i])) return false;
  }
  return true;
}

bool contains_any_case(std::string_view text, std::string_view part) {
  for (std::size_t i = 0; i + part.size() <= text.size(); ++i) {
    if (starts_with_any_case(text.substr(i), part)) return true;
  }
  return false;
}

/// The number at the start of `text`, with how many characters it took. No sign but '-', no exponent.
template <typename Number>
std::optional<std::pair<Number, std::size_t>> leading_number(std::string_view text) {
  Number value{};
  std::from_chars_result result{};
  if constexpr (std::is_floating_point_v<Number>) {
    result = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  } else {
    result = std::from_chars(text.data(), text.data() + text.size(), value);
  }
  if (result.ec != std::errc()) return std::nullopt;
  return std::pair{value, static_cast<std::size_t>(result.ptr - text.data())};
}

/// The number right behind `key` in `text`.
template <typename Number>
std::optional<Number> number_after(std::string_view text, std::string_view key) {
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return std::nullopt;
  const auto number = leading_number<Number>(trim(text.substr(at + key.size())));
  if (!number) return std::nullopt;
  return number->first;
}

/// "T:20.62 /0.00 B:20.62 /0.00 @:0 B@:0 W:?": key, colon, value, and for heaters a target behind a slash.
std::optional<TemperatureReport> parse_temperatures(std::string_view text) {
  text = trim(text);
  if (!(text.starts_with("T:") || text.starts_with("T0:") || text.starts_with("B:"))) return std::nullopt;
  TemperatureReport report;
  while (!text.empty()) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) break;
    const std::size_t blank = text.substr(0, colon).rfind(' ');
    const std::string_view key =
        blank == std::string_view::npos ? text.substr(0, colon) : text.substr(blank + 1, colon - blank - 1);
    text = text.substr(colon + 1);
    if (key == "W") {
      report.waiting = true;
      continue;
    }
    const auto value = leading_number<double>(text);
    if (!value) continue;
    text = trim(text.substr(value->second));
    if (const std::size_t at = key.find('@'); at != std::string_view::npos) {
      // "@" and "B@" carry the power of heater "T" and "B", "@0" that of "T0".
      const std::string heater = at > 0 ? std::string(key.substr(0, at)) : fmt::format("T{}", key.substr(1));
      // What noise makes of it may be any number, or none.
      const bool plausible = value->first >= 0 && value->first <= kMostPower;
      for (HeaterReading& reading : report.heaters) {
        if (reading.heater == heater && plausible) reading.power = static_cast<int>(value->first);
      }
      continue;
    }
    HeaterReading reading{std::string(key), value->first, 0, std::nullopt};
    if (!text.empty() && text.front() == '/') {
      text = trim(text.substr(1));
      if (const auto target = leading_number<double>(text)) {
        reading.target = target->first;
        text = text.substr(target->second);
      }
    }
    report.heaters.push_back(std::move(reading));
  }
  if (report.heaters.empty()) return std::nullopt;
  return report;
}

std::optional<OkReply> parse_ok(std::string_view line) {
  OkReply reply;
  if (!starts_with_any_case(line, "ok")) {
    // Forks and old versions glue it to the text before: "echo:ok", "File deleted:a.gcook".
    const bool glued = line == "echo:ok" || (line.starts_with("File deleted:") && line.ends_with("ok"));
    if (!glued) return std::nullopt;
    reply.glued = true;
    return reply;
  }
  std::string_view rest = line.substr(2);
  // A lost line end between two of them; the second one says nothing that the first did not.
  while (starts_with_any_case(rest, "ok")) rest.remove_prefix(2);
  if (!rest.empty() && (is_letter(rest.front()) || is_digit(rest.front()))) return std::nullopt;
  rest = trim(rest);
  if (auto temperatures = parse_temperatures(rest)) {
    reply.temperatures = std::move(temperatures);
    return reply;
  }
  while (rest.size() >= 2) {
    const char key = rest.front();
    const auto number = leading_number<LineNumber>(rest.substr(1));
    if (!number) break;
    if (key == 'N') reply.number = number->first;
    const bool plausible = number->first >= 0 && number->first <= kMostPlaces;
    if (key == 'P' && plausible) reply.planner_free = static_cast<int>(number->first);
    if (key == 'B' && plausible) reply.queue_free = static_cast<int>(number->first);
    rest = trim(rest.substr(1 + number->second));
  }
  return reply;
}

std::optional<ResendReply> parse_resend(std::string_view line) {
  std::size_t at = 0;
  if (starts_with_any_case(line, "resend")) {
    at = 6;
  } else if (starts_with_any_case(line, "rs") && line.size() > 2 && !is_letter(line[2])) {
    at = 2;
  } else {
    return std::nullopt;
  }
  while (at < line.size() && !is_digit(line[at])) ++at;
  if (at < line.size() && line[at - 1] == '-') --at;
  const auto number = leading_number<LineNumber>(line.substr(at));
  if (!number) return std::nullopt;
  return ResendReply{number->first};
}

ErrorReply parse_error(std::string_view text) {
  constexpr std::array<std::string_view, 6> kFatal{"halted", "kill()",          "system stopped",
                                                   "fatal:", "thermal runaway", "printer stopped"};
  constexpr std::array<std::string_view, 4> kProtocol{"checksum", "line number", "last line", "format error"};
  ErrorReply reply;
  reply.text = trim(text);
  for (const std::string_view word : kFatal) {
    if (contains_any_case(text, word)) {
      reply.severity = ErrorClass::kFatal;
      return reply;
    }
  }
  for (const std::string_view word : kProtocol) {
    if (contains_any_case(text, word)) reply.severity = ErrorClass::kProtocol;
  }
  if (reply.severity == ErrorClass::kProtocol) reply.last_line = number_after<LineNumber>(text, "Last Line:");
  return reply;
}

std::optional<PositionReply> parse_position(std::string_view line) {
  if (!line.starts_with("X:")) return std::nullopt;
  const auto x = number_after<double>(line, "X:");
  const auto y = number_after<double>(line, " Y:");
  const auto z = number_after<double>(line, " Z:");
  const auto e = number_after<double>(line, " E:");
  if (!x || !y || !z) return std::nullopt;
  return PositionReply{*x, *y, *z, e.value_or(0)};
}

/// The value of `key` in M115's first line. Values hold blanks: one ends where the next KEY: begins.
std::string firmware_value(std::string_view line, std::string_view key) {
  const std::size_t at = line.find(key);
  if (at == std::string_view::npos) return {};
  std::string_view value = line.substr(at + key.size());
  for (const std::string_view next :
       {" SOURCE_CODE_URL:", " PROTOCOL_VERSION:", " MACHINE_TYPE:", " KINEMATICS:", " EXTRUDER_COUNT:",
        " AXIS_COUNT:", " UUID:", " FIRMWARE_URL:"}) {
    value = value.substr(0, value.find(next));
  }
  return std::string(trim(value));
}

BusyReason busy_reason(std::string_view text) {
  if (text == "processing") return BusyReason::kProcessing;
  if (text == "paused for user") return BusyReason::kPausedForUser;
  if (text == "paused for input") return BusyReason::kPausedForInput;
  return BusyReason::kOther;
}

HostActionReply parse_host_action(std::string_view text) {
  text = trim(text);
  const std::size_t blank = text.find(' ');
  if (blank == std::string_view::npos) return {std::string(text), ""};
  return {std::string(text.substr(0, blank)), std::string(trim(text.substr(blank)))};
}

/// What follows `prefix` in `line`, if it starts with it.
std::optional<std::string_view> behind(std::string_view line, std::string_view prefix) {
  if (!line.starts_with(prefix)) return std::nullopt;
  return line.substr(prefix.size());
}

/// The first two lines after a start: either may be lost in the noise of it.
bool is_boot_line(std::string_view line) {
  constexpr std::array<std::string_view, 6> kBootLines{"start",          "PowerUp",         "External Reset",
                                                       "Watchdog Reset", "Brown out Reset", "Software Reset"};
  return std::find(kBootLines.begin(), kBootLines.end(), line) != kBootLines.end();
}

std::optional<std::string_view> error_text(std::string_view line) {
  if (starts_with_any_case(line, "error:")) return line.substr(6);
  // With the blank: the noise of a bad link makes "!!" of other text easily enough.
  if (line == "!!" || line.starts_with("!! ")) return line;
  if (starts_with_any_case(line, "fatal:")) return line;
  return std::nullopt;
}

}  // namespace

const HeaterReading* TemperatureReport::find(const std::string& heater) const {
  for (const HeaterReading& reading : heaters) {
    if (reading.heater == heater) return &reading;
  }
  return nullptr;
}

Reply parse_reply(std::string_view line) {
  line = trim(line);
  if (auto ok = parse_ok(line)) return *std::move(ok);
  if (const auto resend = parse_resend(line)) return *resend;
  if (is_boot_line(line)) return StartReply{};
  if (line == "wait") return WaitReply{};
  if (const auto text = error_text(line)) {
    ErrorReply reply = parse_error(*text);
    if (!starts_with_any_case(line, "error:")) reply.severity = ErrorClass::kFatal;
    return reply;
  }
  if (const auto text = behind(line, "echo:busy:")) return BusyReply{busy_reason(trim(*text))};
  if (const auto text = behind(line, "busy:")) return BusyReply{busy_reason(trim(*text))};
  if (auto text = behind(line, "echo:Unknown command: \"")) {
    if (text->ends_with('"')) text->remove_suffix(1);
    return UnknownCommandReply{std::string(*text)};
  }
  for (const std::string_view prefix : {"//action:", "// action:"}) {
    if (const auto text = behind(line, prefix)) return parse_host_action(*text);
  }
  if (const auto text = behind(line, "Cap:")) {
    const std::size_t colon = text->rfind(':');
    if (colon != std::string_view::npos) {
      return CapabilityReply{std::string(text->substr(0, colon)), text->substr(colon + 1) == "1"};
    }
  }
  if (line.find("FIRMWARE_NAME:") != std::string_view::npos) {
    return FirmwareReply{firmware_value(line, "FIRMWARE_NAME:"), firmware_value(line, "MACHINE_TYPE:"),
                         number_after<int>(line, "EXTRUDER_COUNT:")};
  }
  if (const auto position = parse_position(line)) return *position;
  if (auto temperatures = parse_temperatures(line)) return *std::move(temperatures);
  return TextReply{std::string(line)};
}

std::vector<std::string> ReplyLines::push(std::string_view bytes) {
  std::vector<std::string> lines;
  for (const char byte : bytes) {
    const bool ends = byte == '\n' || byte == '\r';
    if (!ends) partial_ += byte;
    if ((ends && !partial_.empty()) || partial_.size() >= kMaxReplyBytes) {
      lines.push_back(std::exchange(partial_, {}));
    }
  }
  return lines;
}

}  // namespace lamina::transport
