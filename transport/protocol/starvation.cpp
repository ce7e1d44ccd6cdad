#include "transport/protocol/starvation.h"

#include <algorithm>

namespace lamina::transport {

void StarvationClock::planner_free(int blocks) {
  planner_free_ = blocks;
  planner_blocks_ = std::max(planner_blocks_, blocks);
}

void StarvationClock::move_acknowledged(bool at_once) {
  hungry_ = planner_free_ ? 2 * *planner_free_ > planner_blocks_ : at_once;
}

void StarvationClock::advance(Instant now, StarvationCause cause) {
  const Duration span = last_ ? now - *last_ : Duration{};
  last_ = now;
  if (!hungry_) return;
  switch (cause) {
    case StarvationCause::kNone:
      break;
    case StarvationCause::kWire:
      total_.by_wire += span;
      break;
    case StarvationCause::kRecovery:
      total_.by_recovery += span;
      break;
    case StarvationCause::kSource:
      total_.by_source += span;
      break;
  }
}

}  // namespace lamina::transport
