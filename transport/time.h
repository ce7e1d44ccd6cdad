#pragma once

#include <chrono>
#include <cstdint>

namespace lamina::transport {

/// The clock of this folder. Nobody reads it: whoever owns the wall clock (the runner, the emulator server)
/// or the simulated one hands the time in, so that ten hours of printing are a test of some seconds.
struct Timeline {};

/// A span of time. Whole nanoseconds, so that sums of spans are exact and equal on every machine.
using Duration = std::chrono::nanoseconds;

/// A moment on the caller's timeline. Moment - moment is a span; moment + moment does not compile.
using Instant = std::chrono::time_point<Timeline, Duration>;

/// The longest span that is made of seconds: with a moment of today it still adds up.
inline constexpr double kLongestSeconds = 3e9;

/// `seconds` as a span, rounded to the nearest nanosecond, at most some ninety years; no number is none.
constexpr Duration from_seconds(double seconds) {
  if (!(seconds > -kLongestSeconds)) seconds = seconds < 0 ? -kLongestSeconds : 0;
  if (seconds > kLongestSeconds) seconds = kLongestSeconds;
  return Duration(static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5)));
}

/// A span in seconds.
constexpr double to_seconds(Duration span) {
  return std::chrono::duration<double>(span).count();
}

}  // namespace lamina::transport
