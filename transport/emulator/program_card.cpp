// The SD card.

#include <algorithm>

#include <fmt/format.h>

#include "transport/emulator/program_maker.h"

namespace lamina::transport {

bool ProgramMaker::card_code() {
  if (!options_.features.sd_card) return false;
  switch (command_.code) {
    case 20:
      list_files();
      return true;
    case 21:
      say("echo:SD card ok\n");
      return true;
    case 22:
      card_.restart();
      say("echo:SD card released\n");
      return true;
    case 23:
      select_file();
      return true;
    case 24:
      card_.print();
      return true;
    case 25:
      card_.pause();
      return true;
    case 26:
      if (card_.selected())
        card_.seek(static_cast<std::size_t>(std::max(0, command_.integer('S').value_or(0))));
      return true;
    case 27:
      if (command_.has('S')) {
        settings_.card_interval = from_seconds(std::clamp(value('S', 0), 0.0, 60.0));
      } else if (command_.has('C')) {
        say(card_.selected() ? fmt::format("Current file: {}\n", card_.selected_name())
                             : "Current file: (no file)\n");
      } else {
        say(card_progress(card_));
      }
      return true;
    case 28: {
      card_.begin_file(command_.string);
      say(fmt::format("Writing to file: {}\n", command_.string));
      return true;
    }
    case 29:
      // Without a file being written it does nothing.
      return true;
    case 30:
      say(card_.remove(command_.string) ? fmt::format("File deleted:{}\n", command_.string)
                                        : fmt::format("Deletion failed, File: {}.\n", command_.string));
      return true;
    case 32:
      select_file();
      card_.print();
      return true;
    case 33:
      say(fmt::format("{}\n", command_.string));
      return true;
    case 524:
      card_.abort();
      return true;
    default:
      return false;
  }
}

void ProgramMaker::list_files() {
  std::string text = "Begin file list\n";
  for (const auto& [name, content] : card_.files()) text += fmt::format("{} {}\n", name, content.size());
  say(text + "End file list\n");
}

void ProgramMaker::select_file() {
  std::string name = command_.string;
  std::erase(name, '!');
  if (!card_.select(name)) {
    say(fmt::format("open failed, File: {}.\n", name));
    return;
  }
  say(fmt::format("echo:Now fresh file: {}\nFile opened: {} Size: {}\nFile selected\n", name, name,
                  card_.size()));
}

std::string card_progress(const SdCard& card) {
  if (!card.selected()) return "Not SD printing\n";
  return fmt::format("SD printing byte {}/{}\n", card.position(), card.size());
}

}  // namespace lamina::transport
