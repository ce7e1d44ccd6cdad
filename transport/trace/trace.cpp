#include "transport/trace/trace.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <functional>

#include <fmt/format.h>

namespace lamina::transport {

namespace {

constexpr std::string_view kFirstLine = "lamina trace 1";
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::size_t kDecimals = 9;
constexpr std::string_view kHexDigits = "0123456789abcdef";

void append_escaped(std::string& text, std::string_view bytes) {
  for (const char byte : bytes) {
    const auto value = static_cast<unsigned char>(byte);
    if (byte == '\\') {
      text += "\\\\";
    } else if (byte == '\n') {
      text += "\\n";
    } else if (byte == '\r') {
      text += "\\r";
    } else if (byte == '\t') {
      text += "\\t";
    } else if (value >= ' ' && value <= '~') {
      text += byte;
    } else {
      text += "\\x";
      text += kHexDigits[value >> 4];
      text += kHexDigits[value & 15];
    }
  }
}

std::size_t hex_value(char digit) {
  return kHexDigits.find(digit);
}

/// One line of the text, for reading.
class Line {
 public:
  Line(std::size_t number, std::string_view text) : number_(number), text_(text) {}

  TraceEntry entry() {
    TraceEntry entry;
    entry.at = time();
    entry.event = event();
    if (!text_.empty()) {
      expect(text_.front() == ' ', "a blank must follow the event");
      text_.remove_prefix(1);
      entry.bytes = bytes();
    }
    return entry;
  }

  /// "key value".
  std::pair<std::string_view, std::string_view> field() const {
    const std::size_t blank = text_.find(' ');
    expect(blank != std::string_view::npos, "a field is a name and a value");
    return {text_.substr(0, blank), text_.substr(blank + 1)};
  }

  std::int64_t number(std::string_view text) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    expect(error == std::errc() && end == text.data() + text.size() && value >= 0, "a whole number is due");
    return value;
  }

  void expect(bool right, const char* why) const {
    if (!right) throw TraceError(number_, why);
  }

 private:
  Instant time() {
    const std::size_t dot = text_.find('.');
    const std::size_t end = text_.find(' ');
    expect(dot != std::string_view::npos && end == dot + 1 + kDecimals,
           "a line begins with the time in seconds, with nine decimals");
    const std::int64_t seconds = number(text_.substr(0, dot));
    const std::int64_t nanoseconds = number(text_.substr(dot + 1, kDecimals));
    expect(seconds <= INT64_MAX / kNanosecondsPerSecond - 1, "the time is out of range");
    text_.remove_prefix(end + 1);
    return Instant{Duration(seconds * kNanosecondsPerSecond + nanoseconds)};
  }

  TraceEvent event() {
    constexpr std::string_view kEvents = "><~!";
    expect(!text_.empty() && kEvents.find(text_.front()) != std::string_view::npos,
           "the event is one of > < ~ !");
    const auto event = static_cast<TraceEvent>(text_.front());
    text_.remove_prefix(1);
    return event;
  }

  std::string bytes() const {
    std::string bytes;
    for (std::size_t i = 0; i < text_.size(); ++i) {
      if (text_[i] != '\\') {
        bytes += text_[i];
        continue;
      }
      expect(++i < text_.size(), "a backslash stands at the end");
      switch (text_[i]) {
        case '\\':
          bytes += '\\';
          break;
        case 'n':
          bytes += '\n';
          break;
        case 'r':
          bytes += '\r';
          break;
        case 't':
          bytes += '\t';
          break;
        case 'x': {
          const bool both =
              i + 2 < text_.size() && hex_value(text_[i + 1]) < 16 && hex_value(text_[i + 2]) < 16;
          expect(both, "\\x wants two hexadecimal digits, in lower case");
          bytes += static_cast<char>(hex_value(text_[i + 1]) * 16 + hex_value(text_[i + 2]));
          i += 2;
          break;
        }
        default:
          expect(false, "no such escape: \\n \\r \\t \\xHH \\\\");
      }
    }
    return bytes;
  }

  std::size_t number_;
  std::string_view text_;
};

void read_field(TraceHeader& header, const Line& line) {
  const auto [name, value] = line.field();
  EngineOptions& engine = header.engine;
  if (name == "port") {
    header.port = value;
  } else if (name == "window_lines") {
    engine.window.lines = static_cast<std::size_t>(line.number(value));
  } else if (name == "window_bytes") {
    engine.window.bytes = static_cast<std::size_t>(line.number(value));
  } else if (name == "hold_ends") {
    engine.window.hold_ends = line.number(value) != 0;
  } else if (name == "baud") {
    engine.baud = static_cast<int>(line.number(value));
  } else if (name == "short_numbers") {
    engine.form.short_numbers = line.number(value) != 0;
  } else if (name == "blanks") {
    engine.form.blanks = line.number(value) != 0;
  } else if (name == "meatpack") {
    engine.meatpack = line.number(value) != 0;
  } else if (name == "meatpack_after") {
    engine.meatpack_after = static_cast<std::size_t>(line.number(value));
  } else if (name == "start_wait_ms") {
    engine.start_wait = std::chrono::milliseconds(line.number(value));
  } else {
    line.expect(false, "no such field");
  }
}

}  // namespace

TraceError::TraceError(std::size_t number, const std::string& why)
    : std::runtime_error(fmt::format("line {} of the trace: {}", number, why)), line(number) {}

std::string to_text(const TraceHeader& header) {
  const EngineOptions& engine = header.engine;
  return fmt::format(
      "{}\nport {}\nwindow_lines {}\nwindow_bytes {}\nhold_ends {:d}\nbaud {}\nshort_numbers {:d}\nblanks "
      "{:d}\nmeatpack {:d}\nmeatpack_after {}\n"
      "start_wait_ms {}\n\n",
      kFirstLine, header.port, engine.window.lines, engine.window.bytes, engine.window.hold_ends, engine.baud,
      engine.form.short_numbers, engine.form.blanks, engine.meatpack, engine.meatpack_after,
      engine.start_wait / std::chrono::milliseconds(1));
}

void append_text(std::string& text, const TraceEntry& entry) {
  const std::int64_t at = entry.at.time_since_epoch().count();
  fmt::format_to(std::back_inserter(text), "{}.{:09} {}", at / kNanosecondsPerSecond,
                 at % kNanosecondsPerSecond, static_cast<char>(entry.event));
  if (!entry.bytes.empty()) text += ' ';
  append_escaped(text, entry.bytes);
  text += '\n';
}

std::string to_text(const Trace& trace) {
  std::string text = to_text(trace.header);
  for (const TraceEntry& entry : trace.entries) append_text(text, entry);
  return text;
}

Trace parse_trace(std::string_view text) {
  Trace trace;
  bool in_header = true;
  std::size_t number = 0;
  for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1)) {
    Line line(++number, text.substr(0, end));
    if (number == 1) {
      line.expect(text.substr(0, end) == kFirstLine, "not a trace: it must begin with \"lamina trace 1\"");
    } else if (in_header) {
      in_header = end > 0;
      if (in_header) read_field(trace.header, line);
    } else {
      trace.entries.push_back(line.entry());
      const std::size_t count = trace.entries.size();
      line.expect(count < 2 || trace.entries[count - 2].at <= trace.entries[count - 1].at,
                  "time goes backwards");
    }
  }
  if (number == 0) throw TraceError(1, "not a trace: it must begin with \"lamina trace 1\"");
  return trace;
}

std::string escaped(std::string_view bytes) {
  std::string text;
  append_escaped(text, bytes);
  return text;
}

}  // namespace lamina::transport
