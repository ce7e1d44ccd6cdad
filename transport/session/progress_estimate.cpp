#include "transport/session/progress_estimate.h"

#include <algorithm>
#include <charconv>

#include "transport/protocol/command_words.h"

namespace lamina::transport {

namespace {

template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  return value;
}

std::optional<std::string_view> behind(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  return text.substr(prefix.size());
}

}  // namespace

void ProgressEstimate::read(std::string_view line) {
  if (line.starts_with(';')) read_comment(line.substr(1));
  if (line.starts_with("M73")) read_progress(line);
}

void ProgressEstimate::read_comment(std::string_view comment) {
  if (comment.starts_with("LAYER_CHANGE")) {
    ++layer_;
  } else if (const auto count = behind(comment, "LAYER_COUNT:")) {
    layer_count_ = number_in<std::int64_t>(*count).value_or(layer_count_);
  } else if (const auto index = behind(comment, "LAYER:")) {
    // Cura counts a raft below 0.
    layer_ = std::max<std::int64_t>(0, number_in<std::int64_t>(*index).value_or(layer_ - 1) + 1);
  } else if (const auto total = behind(comment, "TIME:")) {
    total_ = number_in<double>(*total);
  } else if (const auto elapsed = behind(comment, "TIME_ELAPSED:")) {
    elapsed_ = number_in<double>(*elapsed);
  }
}

void ProgressEstimate::read_progress(std::string_view command) {
  const CommandWords words(command.substr(0, command.find(';')));
  if (words.code() != "M73") return;
  constexpr double kMinute = 60;
  if (const auto percent = words.number('P')) percent_ = *percent;
  if (const auto left = words.number('R')) left_ = *left * kMinute;
}

std::optional<double> ProgressEstimate::fraction() const {
  if (total_ && elapsed_ && *total_ > 0) return std::clamp(*elapsed_ / *total_, 0.0, 1.0);
  if (percent_) return std::clamp(*percent_ / 100, 0.0, 1.0);
  return std::nullopt;
}

std::optional<double> ProgressEstimate::seconds_left() const {
  if (total_ && elapsed_) return std::max(0.0, *total_ - *elapsed_);
  return left_;
}

}  // namespace lamina::transport
