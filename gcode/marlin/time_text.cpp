#include "gcode/marlin/time_text.h"

#include <chrono>
#include <cmath>

namespace lamina::gcode {
namespace {

std::string padded(std::int64_t value, std::size_t digits) {
  std::string text = std::to_string(value);
  return text.size() < digits ? std::string(digits - text.size(), '0') + text : text;
}

}  // namespace

std::string duration_text(double seconds) {
  const long long total = std::llround(seconds);
  std::string text;
  if (total >= 86400) text += std::to_string(total / 86400) + "d ";
  if (total >= 3600) text += std::to_string(total / 3600 % 24) + "h ";
  if (total >= 60) text += std::to_string(total / 60 % 60) + "m ";
  return text + std::to_string(total % 60) + "s";
}

std::string timestamp_text(std::int64_t seconds) {
  const std::chrono::sys_seconds time{std::chrono::seconds(seconds)};
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(time - day);
  return padded(static_cast<int>(date.year()), 4) + "-" + padded(static_cast<unsigned>(date.month()), 2) +
         "-" + padded(static_cast<unsigned>(date.day()), 2) + " at " + padded(clock.hours().count(), 2) +
         ":" + padded(clock.minutes().count(), 2) + ":" + padded(clock.seconds().count(), 2) + " UTC";
}

}  // namespace lamina::gcode
