#include "transport/emulator/wire.h"

#include <algorithm>

namespace lamina::transport {

Wire::Wire(const WireOptions& options)
    : options_(options), since_damage_(options.faults.spacing), random_(options.faults.seed) {}

void Wire::send(std::string_view bytes, Instant now) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const std::string_view line = bytes.substr(0, end == std::string_view::npos ? end : end + 1);
    bytes.remove_prefix(line.size());
    if (line.starts_with("ok") && chance(options_.faults.lose_ok)) continue;
    send_line(line, now);
    if (line.starts_with("ok") && chance(options_.faults.double_ok)) send_line(line, now);
    if (line.starts_with("Resend") && chance(options_.faults.double_resend)) send_line(line, now);
  }
}

std::string Wire::take_arrived(Instant now) {
  std::string arrived;
  while (!under_way_.empty() && under_way_.front().arrives <= now) {
    arrived += under_way_.front().value;
    under_way_.pop_front();
  }
  return arrived;
}

void Wire::put_back(std::string_view bytes, Instant now) {
  // (These have arrived: they are in no packet that is still being filled.)
  for (auto byte = bytes.rbegin(); byte != bytes.rend(); ++byte) under_way_.push_front({now, *byte});
}

std::optional<Instant> Wire::next_arrival() const {
  if (under_way_.empty()) return std::nullopt;
  return under_way_.front().arrives;
}

bool Wire::chance(double probability) {
  if (probability <= 0) return false;
  constexpr double kRange = 18446744073709551616.0;  // 2^64
  return static_cast<double>(random_()) < probability * kRange;
}

void Wire::send_line(std::string_view line, Instant now) {
  for (const char byte : line) send_byte(byte, now);
}

void Wire::send_byte(char byte, Instant now) {
  free_ = std::max(free_, now);
  const WireFaults& faults = options_.faults;
  const std::uint64_t position = sent_++;
  const auto ordered = [&](ByteFault fault) {
    return std::any_of(faults.ordered.begin(), faults.ordered.end(), [&](const OrderedByteFault& order) {
      return order.fault == fault && order.byte == position;
    });
  };
  // At most one thing happens to a byte.
  const bool by_chance = ++since_damage_ > faults.spacing;
  const auto happens = [&](ByteFault fault, double probability) {
    return (by_chance && chance(probability)) || ordered(fault);
  };
  const bool drop = happens(ByteFault::kDrop, faults.drop);
  const bool flip = !drop && happens(ByteFault::kFlip, faults.flip);
  const bool repeat = !drop && !flip && happens(ByteFault::kRepeat, faults.repeat);
  const bool insert = !drop && !flip && !repeat && happens(ByteFault::kInsert, faults.insert);
  if (drop || flip || repeat || insert) {
    since_damage_ = 0;
    ++damaged_;
  }
  if (insert) put_on(static_cast<char>(random_() % 256));
  if (flip) byte = static_cast<char>(byte ^ (1 << (random_() % 8)));
  if (repeat) put_on(byte);
  if (drop) return;
  put_on(byte);
}

void Wire::put_on(char byte) {
  if (options_.baud > 0) free_ += from_seconds(10.0 / options_.baud);
  if (options_.packet == 0) {
    under_way_.push_back({free_ + options_.latency, byte});
    return;
  }
  // A packet's bytes arrive together: when it is full, or when its first byte has waited long enough.
  if (packet_size_ == 0 || free_ > packet_leaves_) {
    packet_size_ = 0;
    packet_leaves_ = free_ + options_.latency;
  }
  under_way_.push_back({packet_leaves_, byte});
  if (++packet_size_ < options_.packet) return;
  for (std::size_t i = 0; i < packet_size_ && i < under_way_.size(); ++i)
    under_way_[under_way_.size() - 1 - i].arrives = free_;
  packet_size_ = 0;
}

}  // namespace lamina::transport
