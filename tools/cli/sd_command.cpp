#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "tools/cli/failure.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/json.h"
#include "tools/cli/profile_arguments.h"
#include "tools/cli/progress_bar.h"
#include "tools/cli/verbs.h"
#include "transport/port/port.h"
#include "transport/protocol/line_stripper.h"
#include "transport/session/card_protocol.h"
#include "transport/session/runner.h"

namespace lamina::tools {
namespace {

using transport::CommandAnswer;

struct CardArguments {
  std::vector<std::string> words;  ///< list | upload FILE [NAME] | print NAME | progress | delete NAME
  std::string port;
  std::optional<double> baud;
  double time_scale = 1.0;
  ProfileArguments profile;
  bool json = false;
  bool quiet = false;
};

constexpr const char* kActions = "list, upload FILE [NAME], print NAME, progress or delete NAME";

/// One conversation with the card's printer.
class Card {
 public:
  explicit Card(const CardArguments& arguments) : arguments_(arguments), interrupted_(defer_interrupts()) {
    transport::PortOptions options = resolve(arguments.profile).settings.port;
    if (arguments.baud) options.baud = static_cast<int>(*arguments.baud);
    port_ = transport::open_port(arguments.port, options);
  }

  /// Sends the commands; `on_answer` gets each with what the printer said.
  void ask(transport::LineSource commands, const std::function<void(const CommandAnswer&)>& on_answer,
           std::size_t window = 1) {
    transport::EngineOptions options;
    options.window.lines = window;
    const auto go_on = [](const CommandAnswer& answer) { return !transport::card_complaint(answer); };
    transport::CommandSession session(std::move(commands), options, go_on);
    transport::run_commands(*port_, session, on_answer, interrupted_, arguments_.time_scale);
    if (!session.failure().empty()) throw Failure(ExitCode::kPort, session.failure());
    if (interrupted_) throw Interrupted("stopped");
  }

  /// A few commands, one by one. A complaint about one of them is a Failure.
  std::vector<CommandAnswer> ask(std::vector<std::string> commands) {
    std::vector<CommandAnswer> answers;
    std::size_t next = 0;
    ask(
        [&]() -> std::optional<std::string> {
          if (next == commands.size()) return std::nullopt;
          return commands[next++];
        },
        [&](const CommandAnswer& answer) { answers.push_back(answer); });
    for (const CommandAnswer& answer : answers) refuse_complaint(answer);
    return answers;
  }

  static void refuse_complaint(const CommandAnswer& answer) {
    if (const auto complaint = transport::card_complaint(answer))
      throw Failure(ExitCode::kPrinter,
                    fmt::format("the printer said to {}: {}", answer.command, *complaint));
  }

  std::vector<transport::CardFile> files() {
    const auto files = transport::card_files(ask({"M21", "M20"}).back());
    if (!files)
      throw Failure(ExitCode::kPrinter,
                    "the printer lists no files: has it a card reader, and a card in it?");
    return *files;
  }

 private:
  const CardArguments& arguments_;
  const std::atomic<bool>& interrupted_;
  std::unique_ptr<transport::Port> port_;
};

void list(const CardArguments& arguments, Card& card) {
  const std::vector<transport::CardFile> files = card.files();
  if (arguments.json) {
    Json json = Json::array();
    for (const auto& file : files)
      json.push_back({{"name", file.name}, {"bytes", file.size}, {"long_name", file.long_name}});
    std::cout << to_text(json) << '\n';
    return;
  }
  for (const auto& file : files)
    std::cout << fmt::format("{:<14} {:>10}  {}\n", file.name,
                             file.size < 0 ? "" : fmt::format("{}", file.size), file.long_name);
  if (files.empty()) std::cout << "the card is empty\n";
}

void upload(const CardArguments& arguments, Card& card, const std::string& path, const std::string& name) {
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  std::ifstream file(path, std::ios::binary);
  if (failed || !file) throw Failure(ExitCode::kInput, "cannot read " + path);
  ProgressBar bar(arguments.quiet);
  bar.begin("Uploading");
  enum class Step { kBegin, kLines, kDone } step = Step::kBegin;
  std::int64_t bytes_read = 0;
  std::int64_t bytes_written = 0;
  std::int64_t lines = 0;
  std::string ending;
  const auto next = [&]() -> std::optional<std::string> {
    if (step == Step::kDone) return std::nullopt;
    if (step == Step::kBegin) {
      step = Step::kLines;
      return "M28 " + name;
    }
    std::string line;
    while (std::getline(file, line)) {
      bytes_read += static_cast<std::int64_t>(line.size()) + 1;
      const std::string command = transport::strip_line(line);
      // M28 and M29 inside a file would end or nest the upload.
      if (command.empty() || command.starts_with("M28") || command.starts_with("M29") ||
          command.find("M110") != std::string::npos)
        continue;
      return command;
    }
    step = Step::kDone;
    return "M29";
  };
  card.ask(
      next,
      [&](const CommandAnswer& answer) {
        if (answer.command.starts_with("M28 ")) Card::refuse_complaint(answer);
        if (answer.command == "M29") {
          for (const std::string& text : answer.text) ending += text;
        }
        ++lines;
        bytes_written += static_cast<std::int64_t>(answer.command.size()) + 1;
        bar.update(static_cast<double>(bytes_read) / static_cast<double>(std::max<std::uintmax_t>(size, 1)),
                   fmt::format("line {}", lines));
      },
      transport::Window{}.lines);
  bar.clear();
  const std::vector<transport::CardFile> files = card.files();
  const bool there = std::any_of(files.begin(), files.end(), [&](const auto& on_card) {
    return on_card.name == name && on_card.size != 0;
  });
  if (!there)
    throw Failure(ExitCode::kPrinter,
                  fmt::format("{} is not on the card after the upload ({})", name, ending));
  std::cout << fmt::format("uploaded {} as {}: {} commands\n", path, name, lines - 2);
}

/// True while the card is printing.
bool say_progress(const CardArguments& arguments, const CommandAnswer& answer) {
  const auto progress = transport::card_progress(answer);
  if (arguments.json) {
    std::cout << to_line(
                     progress
                         ? Json{{"printing", true}, {"byte", progress->position}, {"bytes", progress->size}}
                         : Json{{"printing", false}})
              << '\n';
  } else if (progress) {
    std::cout << fmt::format("{} of {} bytes, {:.1f} %\n", progress->position, progress->size,
                             100.0 * static_cast<double>(progress->position) /
                                 static_cast<double>(std::max<std::int64_t>(progress->size, 1)));
  } else {
    std::cout << "nothing is being printed from the card\n";
  }
  return progress.has_value();
}

ExitCode run(const CardArguments& arguments) {
  const std::vector<std::string>& words = arguments.words;
  if (arguments.port.empty()) throw Failure(ExitCode::kUsage, "lamina sd needs --port DEVICE");
  if (!(arguments.time_scale > 0.0)) throw Failure(ExitCode::kUsage, "--time-scale must be a number above 0");
  const std::string action = words.empty() ? "" : words.front();
  const auto takes = [&](std::size_t least, std::size_t most) {
    if (words.size() < least + 1 || words.size() > most + 1)
      throw Failure(ExitCode::kUsage, "lamina sd " + action + ": wrong number of arguments",
                    std::string("it is one of ") + kActions);
  };
  if (action == "list") {
    takes(0, 0);
    Card card(arguments);
    list(arguments, card);
  } else if (action == "upload") {
    takes(1, 2);
    const std::string name = words.size() > 2 ? words[2] : transport::card_name(words[1]);
    Card card(arguments);
    upload(arguments, card, words[1], name);
  } else if (action == "print") {
    takes(1, 1);
    Card(arguments).ask({"M23 " + words[1], "M24"});
    std::cout << "printing " << words[1] << " from the card\n";
  } else if (action == "progress") {
    takes(0, 0);
    say_progress(arguments, Card(arguments).ask({"M27"}).back());
  } else if (action == "delete") {
    takes(1, 1);
    Card(arguments).ask({"M30 " + words[1]});
    std::cout << "deleted " << words[1] << '\n';
  } else {
    throw Failure(ExitCode::kUsage,
                  action.empty() ? "lamina sd needs to know what to do" : "lamina sd cannot '" + action + "'",
                  std::string("it is one of ") + kActions);
  }
  return ExitCode::kOk;
}

}  // namespace

Verb sd_verb() {
  const auto arguments = std::make_shared<CardArguments>();
  return {
      "sd", "Work with the SD card in a printer: list, upload, print, progress, delete",
      "  lamina sd list --port /dev/ttyUSB0\n"
      "  lamina sd upload part.gcode --port /dev/ttyUSB0       as PART.GCO\n"
      "  lamina sd print PART.GCO --port /dev/ttyUSB0\n"
      "  lamina sd progress --port /dev/ttyUSB0",
      [arguments](OptionSet& options) {
        options.arguments("ACTION", arguments->words, kActions);
        options.text("--port", arguments->port, "DEVICE", "Printer, such as /dev/ttyUSB0 or tcp://HOST:PORT");
        options.number("--baud", arguments->baud, "N", "Its speed; 0 tries the usual ones [the profile's]");
        options.number("--time-scale", arguments->time_scale, "N",
                       "N seconds in one, as of 'lamina emulate' [1]");
        arguments->profile.declare(options);
        options.flag("--json", arguments->json, "Answer as JSON");
        options.flag("--quiet", arguments->quiet, "No progress");
      },
      [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
