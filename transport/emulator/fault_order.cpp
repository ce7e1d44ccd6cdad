#include "transport/emulator/fault_order.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace lamina::transport {

namespace {

struct KindName {
  FaultKind kind;
  std::string_view name;
  double amount;  ///< where none is given
  std::string_view effect;
};

constexpr std::array kKinds{
    KindName{FaultKind::kFlip, "flip", 1, "a bit of a byte to the printer turned over"},
    KindName{FaultKind::kDrop, "drop", 1, "a byte to the printer lost"},
    KindName{FaultKind::kRepeat, "repeat", 1, "a byte to the printer doubled"},
    KindName{FaultKind::kInsert, "insert", 1, "a byte to the printer too many"},
    KindName{FaultKind::kFlipReply, "flip-reply", 1, "a bit of a byte to the host turned over"},
    KindName{FaultKind::kDropReply, "drop-reply", 1, "... lost"},
    KindName{FaultKind::kRepeatReply, "repeat-reply", 1, "... doubled"},
    KindName{FaultKind::kInsertReply, "insert-reply", 1, "... too many"},
    KindName{FaultKind::kLoseOk, "lose-ok", 1, "the next ok is not said"},
    KindName{FaultKind::kRepeatOk, "repeat-ok", 1, "the next ok is said twice"},
    KindName{FaultKind::kMangleOk, "mangle-ok", 1, "=TEXT is said instead of the next ok"},
    KindName{FaultKind::kRefuseNumber, "refuse-number", 1,
             "the next line is refused for its number, =N times"},
    KindName{FaultKind::kRefuseChecksum, "refuse-checksum", 1, "... for its checksum"},
    KindName{FaultKind::kRefuseMissing, "refuse-missing", 1, "... for want of a checksum"},
    KindName{FaultKind::kRefuseSilently, "refuse-silently", 1, "... without asking for it again"},
    KindName{FaultKind::kResendStorm, "resend-storm", 3, "=N requests for the next line, for no reason"},
    KindName{FaultKind::kStall, "stall", 5, "reads and runs nothing for =SECONDS"},
    KindName{FaultKind::kSilence, "silence", 0, "says nothing for =SECONDS, or for good"},
    KindName{FaultKind::kFullBuffer, "full-buffer", 0.01, "loses what arrives in =SECONDS"},
    KindName{FaultKind::kSay, "say", 1, "says the line =TEXT"},
    KindName{FaultKind::kRestart, "restart", 0, "is off for =SECONDS, then starts anew"},
    KindName{FaultKind::kHeaterFails, "heater-fails", 1, "the hotend heats no more"},
    KindName{FaultKind::kThermalRunaway, "thermal-runaway", 1, "halts with a thermal runaway"},
    KindName{FaultKind::kSlowCard, "slow-card", 1, "=SECONDS between lines from the SD card"},
    KindName{FaultKind::kUnplug, "unplug", 1, "the cable is pulled"}};

constexpr std::array<std::pair<std::string_view, FaultClock>, 5> kClocks{{{"line", FaultClock::kLine},
                                                                          {"command", FaultClock::kCommand},
                                                                          {"byte", FaultClock::kByte},
                                                                          {"time", FaultClock::kTime},
                                                                          {"chance", FaultClock::kChance}}};

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= 0)) return std::nullopt;
  return value;
}

bool is_byte_fault(FaultKind kind) {
  return kind <= FaultKind::kInsertReply;
}

/// `order` among the faults of the wire it belongs to.
void give_to_wire(const FaultOrder& order, WireFaults& faults) {
  const auto kind = static_cast<std::size_t>(order.kind) % 4;
  if (order.clock == FaultClock::kByte) {
    faults.ordered.push_back({static_cast<ByteFault>(kind), static_cast<std::uint64_t>(order.at)});
    return;
  }
  const std::array<double*, 4> chances{&faults.flip, &faults.drop, &faults.repeat, &faults.insert};
  *chances[kind] = order.at;
}

}  // namespace

FaultOrderError::FaultOrderError(std::string text, const std::string& problem)
    : std::runtime_error(fmt::format("cannot understand the fault '{}': {}", text, problem)),
      order(std::move(text)) {}

FaultOrder parse_fault_order(std::string_view order) {
  const auto fail = [order](const std::string& problem) -> FaultOrderError {
    return {std::string(order), problem};
  };
  const std::size_t at = order.rfind('@');
  if (at == std::string_view::npos) throw fail("write KIND@WHEN:NUMBER, such as lose-ok@line:50");
  std::string_view what = order.substr(0, at);
  const std::string_view when = order.substr(at + 1);
  std::optional<std::string_view> given;
  if (const std::size_t equals = what.find('='); equals != std::string_view::npos) {
    given = what.substr(equals + 1);
    what = what.substr(0, equals);
  }
  const auto kind =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const KindName& k) { return k.name == what; });
  if (kind == kKinds.end()) throw fail(fmt::format("there is no fault '{}'", what));

  FaultOrder result;
  result.kind = kind->kind;
  result.amount = kind->amount;
  const bool takes_text = result.kind == FaultKind::kSay || result.kind == FaultKind::kMangleOk;
  if (takes_text) {
    result.text = given.value_or("");
  } else if (given) {
    const std::optional<double> amount = number(*given);
    if (!amount) throw fail(fmt::format("'{}' is no number of at least 0", *given));
    result.amount = *amount;
  }

  const std::size_t colon = when.find(':');
  const auto clock = std::find_if(kClocks.begin(), kClocks.end(),
                                  [&](const auto& c) { return c.first == when.substr(0, colon); });
  if (clock == kClocks.end() || colon == std::string_view::npos)
    throw fail("after the @ comes line:N, command:N, byte:N, time:SECONDS or chance:P");
  result.clock = clock->second;
  const std::optional<double> moment = number(when.substr(colon + 1));
  if (!moment || (result.clock == FaultClock::kChance && *moment > 1))
    throw fail(fmt::format("'{}' is no number of at least 0 (or no chance)", when.substr(colon + 1)));
  result.at = *moment;
  const bool of_bytes = result.clock == FaultClock::kByte || result.clock == FaultClock::kChance;
  if (is_byte_fault(result.kind) && !of_bytes) throw fail("bytes are damaged by byte:N or chance:P");
  if (!is_byte_fault(result.kind) && result.clock == FaultClock::kByte)
    throw fail("only bytes are damaged by byte:N");
  return result;
}

std::string text_of(const FaultOrder& order) {
  const auto kind =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const KindName& k) { return k.kind == order.kind; });
  const auto clock =
      std::find_if(kClocks.begin(), kClocks.end(), [&](const auto& c) { return c.second == order.clock; });
  const bool has_text = order.kind == FaultKind::kSay || order.kind == FaultKind::kMangleOk;
  const std::string amount = has_text ? order.text : fmt::format("{}", order.amount);
  return fmt::format("{}={}@{}:{}", kind->name, amount, clock->first, order.at);
}

std::string fault_order_help() {
  std::string text;
  for (const KindName& kind : kKinds) text += fmt::format("  {:<16} {}\n", kind.name, kind.effect);
  return text;
}

void give_to_wires(std::vector<FaultOrder>& orders, WireFaults& to_printer, WireFaults& to_host) {
  for (const FaultOrder& order : orders) {
    if (is_byte_fault(order.kind))
      give_to_wire(order, order.kind < FaultKind::kFlipReply ? to_printer : to_host);
  }
  std::erase_if(orders, [](const FaultOrder& order) { return is_byte_fault(order.kind); });
}

}  // namespace lamina::transport
