#include "transport/protocol/wire_clock.h"

#include <algorithm>

namespace lamina::transport {

namespace {

constexpr double kBitsOfByte = 10;

/// Of a printer behind a network.
constexpr int kUsualBaud = 115200;

/// "ok" and half of its line end.
constexpr double kShortestAnswerBytes = 2.5;

/// A burst of so many bytes tells the speed. The answer to M115 has some hundred.
constexpr std::size_t kTellingBytes = 256;

/// What an adapter may have gathered meanwhile.
constexpr std::size_t kPacketBytes = 128;

/// Silence that ends a burst.
constexpr Duration kPause = std::chrono::milliseconds(20);

}  // namespace

void WireClock::sent(std::size_t bytes, Instant now) {
  free_ = std::max(free_, now);
  if (baud_ > 0) free_ += time_of(static_cast<double>(bytes));
}

void WireClock::received(std::size_t bytes, Instant now) {
  const bool begins = now > heard_ + kPause;
  heard_ = now;
  if (begins) {
    burst_begins_ = now;
    burst_bytes_ = 0;
    return;
  }
  burst_bytes_ += bytes;
  if (baud_ <= 0 || burst_bytes_ < kTellingBytes) return;
  const bool as_slow = now >= burst_begins_ + time_of(static_cast<double>(burst_bytes_ - kPacketBytes));
  if (!as_slow) speed_ = Speed::kFiction;
  if (speed_ == Speed::kUnknown) speed_ = Speed::kTrue;
}

bool WireClock::too_early(Instant left, Instant now) const {
  return speed_ == Speed::kTrue && now < left + time_of(kShortestAnswerBytes);
}

Duration WireClock::time_of(double bytes) const {
  return from_seconds(bytes * kBitsOfByte / (baud_ > 0 ? baud_ : kUsualBaud));
}

}  // namespace lamina::transport
