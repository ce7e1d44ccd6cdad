#include "tools/cli/print_journal.h"

#include <charconv>
#include <cstdlib>

#include <fmt/format.h>

#include "tools/cli/failure.h"

namespace lamina::tools {
namespace {

namespace fs = std::filesystem;

/// As the XDG base directory specification has it.
std::optional<fs::path> state_folder() {
  const auto variable = [](const char* name) -> std::optional<fs::path> {
    const char* const value = std::getenv(name);
    if (value == nullptr || *value == '\0') return std::nullopt;
    return fs::path(value);
  };
  if (const auto state = variable("XDG_STATE_HOME")) return *state / "lamina";
  if (const auto home = variable("HOME")) return *home / ".local" / "state" / "lamina";
  return std::nullopt;
}

/// One file for each port: "/dev/ttyUSB0" -> "dev_ttyUSB0.journal".
std::string file_name(const std::string& port) {
  std::string name;
  for (const char c : port) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
    if (plain) name += c;
    if (!plain && !name.empty() && name.back() != '_') name += '_';
  }
  return name + ".journal";
}

transport::JournalFileOptions file_options(const std::string& sync) {
  transport::JournalFileOptions options;
  if (sync.empty()) return options;
  if (sync == "never") {
    options.sync = transport::JournalSync::kNever;
    return options;
  }
  if (sync == "layer") {
    options.sync = transport::JournalSync::kLayer;
    return options;
  }
  double seconds = 0;
  const auto [end, error] = std::from_chars(sync.data(), sync.data() + sync.size(), seconds);
  constexpr double kMost = 3600;
  if (error != std::errc() || end != sync.data() + sync.size() || !(seconds > 0) || seconds > kMost) {
    throw Failure(ExitCode::kUsage,
                  "--journal-sync is '" + sync + "': it must be never, layer, or seconds above 0");
  }
  options.interval = transport::from_seconds(seconds);
  return options;
}

/// The name of a print that was broken off and could be resumed; empty without one.
std::string unfinished(const transport::JournalFile& file) {
  try {
    const std::optional<transport::JournalRecord> left = file.read();
    return left && left->ended.empty() && left->position.lines > 0 ? left->source : "";
  } catch (const transport::JournalError&) {
    return {};  // of another version: nobody could go on with it
  }
}

}  // namespace

void JournalArguments::declare(OptionSet& options) {
  options.flag("--resume", resume,
               "Go on with the print that was broken off; the other arguments as they were");
  options.flag(
      "--after-restart", after_restart,
      "With --resume: also if the printer has restarted. X and Y are homed, the height is taken from the "
      "journal: the part must still stick and nobody may have moved Z");
  options.text("--journal", path, "FILE",
               "Where to note how far the print is [one per port in ~/.local/state]");
  options.flag("--no-journal", none, "Note nothing; such a print cannot be resumed");
  options.text("--journal-sync", sync, "never|layer|S",
               "When the journal is forced onto the disk, or every so many seconds [1]");
}

void JournalArguments::check(bool emulated) const {
  if (none && (resume || !path.empty()))
    throw Failure(ExitCode::kUsage, "--no-journal excludes --resume and --journal");
  if (after_restart && !resume) throw Failure(ExitCode::kUsage, "--after-restart needs --resume");
  if (emulated && (resume || !path.empty()))
    throw Failure(ExitCode::kUsage,
                  "--resume and --journal need --port: an emulated printer ends with its print");
  file_options(sync);
}

PrintJournal open_journal(const JournalArguments& arguments, const std::string& source, std::int64_t size,
                          const std::string& port) {
  if (arguments.none) return {};
  fs::path path = arguments.path;
  if (path.empty()) {
    const std::optional<fs::path> folder = state_folder();
    if (!folder) {
      if (!arguments.resume) return {};
      throw Failure(ExitCode::kUsage,
                    "neither HOME nor XDG_STATE_HOME is set; name the journal with --journal");
    }
    std::error_code failed;
    fs::create_directories(*folder, failed);
    path = *folder / file_name(port);
  }
  std::error_code ignored;
  const fs::path absolute = source == "-" ? fs::path(source) : fs::absolute(source, ignored);
  if (arguments.resume && !fs::exists(path, ignored)) {
    throw Failure(ExitCode::kInput,
                  "nothing to resume on " + port + ": there is no journal " + path.string());
  }
  PrintJournal journal;
  journal.file = std::make_unique<transport::JournalFile>(path, file_options(arguments.sync));
  if (!arguments.resume) {
    journal.forgotten = unfinished(*journal.file);
    return journal;
  }
  journal.left = journal.file->read();
  if (!journal.left) {
    throw Failure(ExitCode::kInput, "nothing to resume on " + port + ": no line of the print had been sent");
  }
  if (!journal.left->ended.empty()) {
    throw Failure(ExitCode::kInput, fmt::format("nothing to resume on {}: the print of {} was {}", port,
                                                journal.left->source, journal.left->ended));
  }
  if (journal.left->source != absolute.string() || journal.left->source_size != size) {
    throw Failure(ExitCode::kInput,
                  fmt::format("{} was being printed there ({} bytes), not {} ({} bytes)",
                              journal.left->source, journal.left->source_size, absolute.string(), size),
                  "resume with the same file");
  }
  return journal;
}

}  // namespace lamina::tools
