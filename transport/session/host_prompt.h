#pragma once

#include <string>
#include <vector>

#include "transport/protocol/reply.h"

namespace lamina::transport {

/// A question that the printer asks its user through the host (//action:prompt_*). The answer is the index of
/// a button.
struct HostPrompt {
  std::string text;
  std::vector<std::string> buttons;
  bool shown = false;  ///< complete, and not taken back

  /// Takes one host action; others than prompt_* change nothing.
  void take(const HostActionReply& action);
};

}  // namespace lamina::transport
