#include "transport/trace/replay.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "transport/protocol/meatpack_decoder.h"

namespace lamina::transport {

namespace {

/// The engine's clock was read a little before the port's, and a deadline can be slept over by as much.
constexpr Duration kClockSlack = std::chrono::milliseconds(20);
/// A port may be full, and take bytes so long after the engine gave them.
constexpr Duration kPatience = std::chrono::milliseconds(500);
/// Of what is shown around a difference.
constexpr std::size_t kShownBytes = 120;
/// Line numbers from here on are the engine's own questions.
constexpr LineNumber kQuestion = 1'000'000'000;

/// A command as it was sent.
struct SentLine {
  const TraceEntry* entry = nullptr;  ///< with its first byte
  LineNumber number = -1;             ///< -1: without a number
  std::string command;
};

SentLine parse_sent(const TraceEntry* entry, std::string_view line) {
  SentLine sent{entry, -1, std::string(line)};
  if (!line.starts_with('N')) return sent;
  const char* const end = line.data() + line.size();
  LineNumber number = 0;
  const auto [rest, error] = std::from_chars(line.data() + 1, end, number);
  if (error != std::errc()) return sent;
  line.remove_prefix(static_cast<std::size_t>(rest - line.data()));
  if (line.starts_with(' ')) line.remove_prefix(1);
  return {entry, number, std::string(line.substr(0, line.rfind('*')))};
}

/// All that was sent, as lines, in order, also those whose end was held back and which were erased before it
/// came. Blank lines are left out.
std::vector<SentLine> sent_lines(const Trace& trace) {
  std::vector<SentLine> lines;
  MeatPackDecoder decoder;
  std::string line;
  const TraceEntry* begin = nullptr;
  bool erasing = false;
  const auto finish = [&] {
    if (!line.empty() && !erasing) lines.push_back(parse_sent(begin, line));
  };
  for (const TraceEntry& entry : trace.entries) {
    if (entry.event != TraceEvent::kSent) continue;
    for (const char byte : entry.bytes) {
      for (const char letter : decoder.push(byte).text) {
        if (letter == '\b') {
          finish();
          erasing = true;
          if (!line.empty()) line.pop_back();
        } else if (letter == '\n') {
          finish();
          erasing = false;
          line.clear();
        } else {
          erasing = false;
          if (line.empty()) begin = &entry;
          line += letter;
        }
      }
    }
  }
  finish();
  return lines;
}

/// Understood by the printer at once, past the queue.
bool is_urgent(std::string_view command) {
  const auto is = [command](std::string_view word) {
    return command.starts_with(word) && (command.size() == word.size() || command[word.size()] == ' ');
  };
  return is("M108") || is("M112") || is("M410") || is("M524") || is("M876");
}

class Replay {
 public:
  explicit Replay(const Trace& trace)
      : trace_(trace),
        lines_(sent_lines(trace)),
        engine_(trace.header.engine),
        last_sent_(last_sent(trace)) {}

  ReplayResult run() {
    begin();
    for (const TraceEntry& entry : trace_.entries) {
      over_ = &entry == last_sent_ || over_;
      if (entry.event == TraceEvent::kFailed) break;
      pass_time(entry.at);
      now_ = std::max(now_, entry.at);
      switch (entry.event) {
        case TraceEvent::kReceived:
          result_.bytes_received += static_cast<std::int64_t>(entry.bytes.size());
          engine_.receive(entry.bytes, now_);
          gather();
          break;
        case TraceEvent::kSent:
          send(entry);
          break;
        case TraceEvent::kDiscarded:
          replayed_.resize(std::min(replayed_.size(), traced_.size()));
          break;
        case TraceEvent::kFailed:
          break;
      }
      catch_up();
      compare(kPatience);
      if (result_.difference) break;
    }
    finish();
    return std::move(result_);
  }

 private:
  /// The engine greets a printer, or rejoins one: which of the two the first line sent tells.
  void begin() {
    if (!lines_.empty() && lines_.front().number >= kQuestion) {
      engine_.rejoin(now_);
    } else {
      engine_.connect(now_);
    }
    gather();
  }

  static const TraceEntry* last_sent(const Trace& trace) {
    const auto last = std::find_if(trace.entries.rbegin(), trace.entries.rend(),
                                   [](const TraceEntry& entry) { return entry.event == TraceEvent::kSent; });
    return last == trace.entries.rend() ? nullptr : &*last;
  }

  /// Lets the engine do what was due long enough before `until`.
  void pass_time(Instant until) {
    for (std::optional<Instant> due = engine_.deadline(); due && *due + kClockSlack < until;
         due = engine_.deadline()) {
      now_ = std::max(now_, *due);
      engine_.tick(now_);
      gather();
      if (engine_.deadline() == due) break;
    }
  }

  /// Hands the engine the commands that begin with the bytes of this entry.
  void send(const TraceEntry& entry) {
    traced_ += entry.bytes;
    tick();
    for (; next_line_ < lines_.size() && lines_[next_line_].entry == &entry; ++next_line_) {
      take_line(lines_[next_line_]);
      tick();
    }
  }

  void take_line(const SentLine& sent) {
    if (sent.number >= 0) {
      // What has its number already is sent again, or was the engine's own idea, as greetings and questions
      // are.
      const bool is_new = sent.number >= engine_.next_number() && sent.number > 0 && sent.number < kQuestion;
      if (is_new) engine_.submit(sent.command, LineOrigin::kJob);
    } else if (is_urgent(sent.command)) {
      engine_.send_urgent(sent.command, now_);
    } else {
      // Spoken past the engine, which has ended, or was ended by its owner just before.
      last_words_ = true;
    }
  }

  /// The clock of the trace may have read the end of a wait a little earlier than this engine's.
  void catch_up() {
    const std::optional<Instant> due = engine_.deadline();
    if (replayed_.size() >= traced_.size() || !due || *due > now_ + kClockSlack) return;
    now_ = std::max(now_, *due);
    tick();
  }

  void tick() {
    engine_.tick(now_);
    gather();
  }

  void gather() {
    const std::string output = engine_.take_output();
    if (!output.empty()) {
      replayed_ += output;
      replayed_at_ = now_;
    }
    for (Event& event : engine_.take_events()) result_.events.push_back({now_, std::move(event)});
  }

  /// Goes over what both have sent. The rest of the longer one may wait for `patience`.
  void compare(Duration patience) {
    const std::size_t both = std::min(traced_.size(), replayed_.size());
    const auto [differs, in_replay] = std::mismatch(
        traced_.begin(), traced_.begin() + static_cast<std::ptrdiff_t>(both), replayed_.begin());
    const auto same = static_cast<std::size_t>(differs - traced_.begin());
    before_.append(traced_, 0, same);
    if (before_.size() > kShownBytes) before_.erase(0, before_.size() - kShownBytes);
    traced_.erase(0, same);
    replayed_.erase(0, same);
    result_.bytes_sent += static_cast<std::int64_t>(same);
    if (traced_.empty() && replayed_.empty()) return;
    const bool differs_now = !traced_.empty() && !replayed_.empty();
    const bool late = !traced_.empty() && !over_;
    const bool never_sent = !replayed_.empty() && now_ > replayed_at_ + patience;
    if (!differs_now && !late && !never_sent) return;
    result_.difference = ReplayDifference{now_, result_.bytes_sent, before_, traced_.substr(0, kShownBytes),
                                          replayed_.substr(0, kShownBytes)};
  }

  void finish() {
    result_.span = now_.time_since_epoch();
    result_.statistics = engine_.statistics();
    if (result_.difference || traced_.empty()) return;
    // The owner has ended the conversation, which may have made the engine say a last thing.
    engine_.close("the trace ends");
    gather();
    over_ = last_words_;
    compare(kPatience);
  }

  const Trace& trace_;
  std::vector<SentLine> lines_;
  ProtocolEngine engine_;
  const TraceEntry* last_sent_;
  ReplayResult result_;
  Instant now_{};
  std::size_t next_line_ = 0;
  bool last_words_ = false;
  bool over_ = false;     ///< nothing more was sent: it may be what the engine says when it is closed
  std::string traced_;    ///< sent in the trace, not yet compared
  std::string replayed_;  ///< sent by the engine, not yet compared
  std::string before_;
  Instant replayed_at_{};
};

}  // namespace

ReplayResult replay(const Trace& trace) {
  return Replay(trace).run();
}

}  // namespace lamina::transport
