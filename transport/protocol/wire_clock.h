#pragma once

#include <cstddef>

#include "transport/time.h"

namespace lamina::transport {

/// When the bytes handed to a serial line have gone over it, at its speed. Whether that speed means anything
/// shows when the printer has much to say at once: native USB, behind the same name and a number, is faster.
class WireClock {
 public:
  /// `baud`: bits per second; 0: not known, or none.
  explicit WireClock(int baud) : baud_(baud) {}

  void sent(std::size_t bytes, Instant now);
  void received(std::size_t bytes, Instant now);

  /// When everything sent so far has left.
  Instant free() const { return free_; }

  /// Of a line whose end was handed over at `sent` and has left at `left`: from when its answer is to be
  /// counted.
  Instant departure(Instant sent, Instant left) const { return speed_ == Speed::kTrue ? left : sent; }

  /// An "ok" that is complete at `now` comes sooner than a line that had left at `left` can be answered. Only
  /// where the line was seen to be as slow as its speed says.
  bool too_early(Instant left, Instant now) const;

  /// That was wrong: nothing better came.
  void distrust() { speed_ = Speed::kFiction; }

  /// How long `bytes` take; where the speed is not known, at a usual one.
  Duration time_of(double bytes) const;

 private:
  enum class Speed { kUnknown, kTrue, kFiction };

  int baud_;
  Speed speed_ = Speed::kUnknown;
  Instant free_{};
  Instant heard_{};
  Instant burst_begins_{};
  std::size_t burst_bytes_ = 0;  ///< without those that were there when it began
};

}  // namespace lamina::transport
