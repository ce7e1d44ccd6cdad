#include "transport/port/baud_search.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace lamina::transport {

namespace {

/// So many bytes that no text holds, and a fifth of all: another speed, not a disturbance.
constexpr std::size_t kGarbledBytes = 4;
constexpr std::size_t kGarbledShare = 5;

bool is_text(char byte) {
  return (byte >= ' ' && byte <= '~') || byte == '\n' || byte == '\r' || byte == '\t';
}

/// What only a printer says. A device that sends back what it is sent, or talks of something else, is none.
bool is_printer_talk(const std::string& line) {
  if (!std::all_of(line.begin(), line.end(), is_text)) return false;
  if (line.starts_with("echo:")) return true;
  return !std::holds_alternative<TextReply>(parse_reply(line));
}

}  // namespace

void BaudSearch::start(Instant now) {
  boot_end_ = now + options_.boot_wait;
  booting_ = options_.boot_wait > Duration{};
  try_rate(0, now);
}

void BaudSearch::receive(std::string_view bytes, Instant now) {
  if (state_ != State::kSearching || bytes.empty()) return;
  bytes_ += bytes.size();
  bad_bytes_ += static_cast<std::size_t>(
      std::count_if(bytes.begin(), bytes.end(), [](char byte) { return !is_text(byte); }));
  const std::vector<std::string> lines = lines_.push(bytes);
  understood_ = understood_ || std::any_of(lines.begin(), lines.end(), is_printer_talk);
  if (understood_) {
    due_ = now + options_.quiet;
  } else if (garbled()) {
    next_rate(now);
  }
}

void BaudSearch::tick(Instant now) {
  if (state_ != State::kSearching || now < due_) return;
  if (understood_) {
    state_ = State::kFound;
  } else if (booting_) {
    booting_ = false;
    try_rate(rate_, now);
  } else {
    next_rate(now);
  }
}

void BaudSearch::refuse(Instant now) {
  next_rate(now);
}

std::string BaudSearch::take_output() {
  return std::exchange(output_, {});
}

bool BaudSearch::garbled() const {
  return bad_bytes_ >= kGarbledBytes && bad_bytes_ * kGarbledShare >= bytes_;
}

void BaudSearch::try_rate(std::size_t rate, Instant now) {
  rate_ = rate;
  bytes_ = 0;
  bad_bytes_ = 0;
  lines_ = {};
  output_.clear();
  if (booting_) {
    due_ = boot_end_;
    return;
  }
  output_ = round_ == 0 ? "\nM105\n" : "\nM115\n";
  due_ = now + options_.answer_waits[round_];
}

void BaudSearch::next_rate(Instant now) {
  if (rate_ + 1 < options_.bauds.size()) {
    try_rate(rate_ + 1, now);
  } else if (booting_) {
    try_rate(0, now);
  } else if (++round_ < options_.answer_waits.size()) {
    try_rate(0, now);
  } else {
    state_ = State::kFailed;
  }
}

int find_baud(Port& port, const BaudSearchOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const auto now = [begin] { return Instant{std::chrono::steady_clock::now() - begin}; };
  BaudSearch search(options);
  search.start(now());
  int baud = 0;
  std::string unsent;
  while (search.state() == BaudSearch::State::kSearching) {
    if (search.baud() != baud) {
      const bool first = baud == 0;
      baud = search.baud();
      try {
        port.set_baud(baud);
      } catch (const PortError& error) {
        if (error.problem != PortProblem::kUnsupportedBaud) throw;
        search.refuse(now());
        continue;
      }
      if (!first) port.discard();
      unsent.clear();
    }
    unsent += search.take_output();
    unsent.erase(0, port.write(unsent));
    port.wait(std::max(search.deadline() - now(), Duration{}), !unsent.empty());
    std::array<char, 1024> bytes;
    const std::size_t count = port.read(bytes);
    search.receive({bytes.data(), count}, now());
    search.tick(now());
  }
  if (search.state() == BaudSearch::State::kFailed) {
    throw PortError(PortProblem::kNoAnswer, port.name(),
                    "no printer answers at " + std::to_string(options.bauds.front()) + " or any of " +
                        std::to_string(options.bauds.size() - 1) + " other baud rates");
  }
  return search.baud();
}

}  // namespace lamina::transport
