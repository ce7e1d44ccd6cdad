#include "transport/session/host_prompt.h"

namespace lamina::transport {

void HostPrompt::take(const HostActionReply& action) {
  if (action.action == "prompt_begin") *this = {action.text, {}, false};
  if (action.action == "prompt_choice" || action.action == "prompt_button") buttons.push_back(action.text);
  if (action.action == "prompt_show") shown = true;
  if (action.action == "prompt_end") *this = {};
}

}  // namespace lamina::transport
