// Whatever waits for somebody: M0, M600, prompts; and M486, by which somebody gives up an object.

#include <fmt/format.h>

#include "transport/emulator/program_maker.h"

namespace lamina::transport {

namespace {

/// How long unloading and loading the filament takes.
constexpr Duration kFilamentTime = std::chrono::seconds(5);

}  // namespace

bool ProgramMaker::user_code() {
  switch (command_.code) {
    case 0:
    case 1:
      user_stop();
      return true;
    case 76:
      // HOST_PAUSE_M76
      if (options_.features.host_actions) say("//action:pause\n");
      return true;
    case 125:
      if (options_.features.filament_change) park();
      return options_.features.filament_change;
    case 486:
      if (options_.features.cancel_objects) cancel_objects();
      return options_.features.cancel_objects;
    case 600:
      if (options_.features.filament_change) change_filament();
      return options_.features.filament_change;
    case 876:
      // The answer itself is seen by the emergency parser, or found in vain here.
      return options_.features.host_actions;
    default:
      return false;
  }
}

void ProgramMaker::user_stop() {
  add(FinishMovesStep{});
  prompt(fmt::format("M{} Stop", command_.code), {"Continue"});
  std::optional<Duration> limit;
  if (command_.has('P')) limit = from_seconds(value('P', 0) / 1000);
  if (command_.has('S')) limit = from_seconds(value('S', 0));
  if (limit == Duration{}) limit.reset();
  add(UserStep{limit});
}

/// Marlin's own change of filament, as a build without a display tells it to the host.
void ProgramMaker::change_filament() {
  const bool to_host = options_.features.host_actions;
  if (to_host) say("//action:paused\n");
  prompt("Pause", {"Dismiss"});
  park();
  add(PositionStep{});
  add(DwellStep{kFilamentTime});
  say("echo:Insert filament and send M108\n");
  wait_for_user("Nozzle Parked", {"Continue"});
  add(DwellStep{kFilamentTime});
  if (!to_host) return;
  wait_for_user("Paused", {"PurgeMore", "Continue"});
  say("//action:prompt_end\n//action:resumed\n");
}

void ProgramMaker::cancel_objects() {
  Machine::Objects& objects = machine_.objects();
  if (command_.has('T')) objects = {};
  if (const auto object = command_.integer('S')) objects.current = *object;
  if (command_.has('C')) objects.cancelled.insert(objects.current);
  if (const auto object = command_.integer('P')) objects.cancelled.insert(*object);
  if (const auto object = command_.integer('U')) objects.cancelled.erase(*object);
}

void ProgramMaker::prompt(const std::string& words, std::initializer_list<const char*> buttons) {
  if (!options_.features.host_actions) return;
  std::string text = fmt::format("//action:prompt_end\n//action:prompt_begin {}\n", words);
  for (const char* button : buttons) text += fmt::format("//action:prompt_button {}\n", button);
  say(text + "//action:prompt_show\n");
}

void ProgramMaker::wait_for_user(const std::string& words, std::initializer_list<const char*> buttons) {
  prompt(words, buttons);
  add(UserStep{});
}

}  // namespace lamina::transport
