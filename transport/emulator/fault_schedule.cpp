#include "transport/emulator/fault_schedule.h"

#include <algorithm>
#include <utility>

namespace lamina::transport {

FaultSchedule::FaultSchedule(std::vector<FaultOrder> orders, std::uint64_t seed, Instant power_up)
    : orders_(std::move(orders)), random_(seed), power_up_(power_up) {}

template <typename Due>
std::vector<FaultOrder> FaultSchedule::take(Due due) {
  std::vector<FaultOrder> taken;
  std::erase_if(orders_, [&](const FaultOrder& order) {
    if (!due(order)) return false;
    taken.push_back(order);
    return order.clock != FaultClock::kChance;
  });
  return taken;
}

std::vector<FaultOrder> FaultSchedule::at_arrival(LineNumber number) {
  if (orders_.empty()) return {};
  return take([&](const FaultOrder& order) {
    return refuses_line(order.kind) && order.clock == FaultClock::kLine &&
           order.at == static_cast<double>(number);
  });
}

std::vector<FaultOrder> FaultSchedule::at_command(std::int64_t count, std::optional<LineNumber> number) {
  if (orders_.empty()) return {};
  return take([&](const FaultOrder& order) {
    if (order.clock == FaultClock::kCommand) return order.at == static_cast<double>(count);
    if (order.clock == FaultClock::kLine)
      return !refuses_line(order.kind) && number && order.at == static_cast<double>(*number);
    return order.clock == FaultClock::kChance && std::generate_canonical<double, 53>(random_) < order.at;
  });
}

std::vector<FaultOrder> FaultSchedule::at_time(Instant now) {
  if (orders_.empty()) return {};
  return take([&](const FaultOrder& order) {
    return order.clock == FaultClock::kTime && power_up_ + from_seconds(order.at) <= now;
  });
}

std::optional<Instant> FaultSchedule::next() const {
  std::optional<Instant> earliest;
  for (const FaultOrder& order : orders_) {
    if (order.clock != FaultClock::kTime) continue;
    const Instant due = power_up_ + from_seconds(order.at);
    if (!earliest || due < *earliest) earliest = due;
  }
  return earliest;
}

bool refuses_line(FaultKind kind) {
  return kind >= FaultKind::kRefuseNumber && kind <= FaultKind::kRefuseSilently;
}

}  // namespace lamina::transport
