#include "tools/cli/print_console.h"

#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tools/cli/failure.h"
#include "tools/cli/interrupt.h"

namespace lamina::tools {
namespace {

using transport::Instant;
using transport::JobPhase;
using transport::PrintJob;

constexpr const char* kHelp =
    "pause, resume, cancel, stop (M112, at once), feed PERCENT, flow PERCENT, nozzle C, bed C, fan PERCENT,\n"
    "objects, skip [NAME], answer N, status; anything else that looks like G-code goes to the printer";

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool looks_like_gcode(std::string_view line) {
  constexpr std::string_view kLetters = "GMTgmt";
  return line.size() > 1 && kLetters.find(line[0]) != std::string_view::npos && line[1] >= '0' &&
         line[1] <= '9';
}

std::string send(PrintJob& job, const std::string& command) {
  return job.inject(command).value_or("");
}

/// A word with one number behind it, within bounds.
struct NumberVerb {
  const char* word;
  double low;
  double high;
  std::string (*command)(double);
};

constexpr std::array<NumberVerb, 5> kNumberVerbs{{
    {"feed", 10, 500, [](double value) { return fmt::format("M220 S{:.0f}", value); }},
    {"flow", 10, 500, [](double value) { return fmt::format("M221 S{:.0f}", value); }},
    {"nozzle", 0, 500, [](double value) { return fmt::format("M104 S{:.0f}", value); }},
    {"bed", 0, 200, [](double value) { return fmt::format("M140 S{:.0f}", value); }},
    {"fan", 0, 100, [](double value) { return fmt::format("M106 S{:.0f}", value * 2.55); }},
}};

std::string objects_text(const PrintJob& job) {
  std::string text;
  for (const std::string& object : job.objects()) {
    const bool skipped = job.skipped_objects().contains(object);
    text += (text.empty() ? "" : "\n") + object + (skipped ? " (skipped)" : "");
  }
  return text.empty() ? "the file has named no object so far" : text;
}

std::string skip(PrintJob& job, std::string_view name) {
  const std::string object = name.empty() ? job.object().value_or("") : std::string(name);
  if (object.empty()) return "no object is being printed just now; name one ('objects' lists them)";
  if (!job.objects().contains(object)) return "the file has named no object '" + object + "' so far";
  job.skip_object(object);
  return "'" + object + "' is left out from here on";
}

std::string status(const PrintJob& job) {
  const transport::JobProgress& progress = job.progress();
  std::string text = fmt::format("line {} of the print acknowledged, layer {}",
                                 progress.job_lines_acknowledged, progress.layer);
  for (const transport::HeaterReading& reading : progress.temperatures.heaters)
    text += fmt::format(", {} {:.0f}/{:.0f} C", reading.heater, reading.current, reading.target);
  return text;
}

}  // namespace

std::string perform(std::string_view line, PrintJob& job, Instant now) {
  line = trim(line);
  if (line.empty()) return {};
  const std::size_t blank = line.find_first_of(" \t");
  const std::string_view word = line.substr(0, blank);
  const std::string_view rest =
      blank == std::string_view::npos ? std::string_view{} : trim(line.substr(blank));
  for (const NumberVerb& verb : kNumberVerbs) {
    if (word != verb.word) continue;
    const std::optional<double> value = number_in(rest);
    if (!value || *value < verb.low || *value > verb.high)
      return fmt::format("{} needs a number from {:.0f} to {:.0f}", verb.word, verb.low, verb.high);
    return send(job, verb.command(*value));
  }
  if (word == "skip") return skip(job, rest);
  if (word == "answer") {
    const std::optional<double> button = number_in(rest);
    if (!button || *button < 0 || *button > 99) return "answer needs the number of a button, from 0";
    job.answer(static_cast<int>(*button), now);
    return {};
  }
  if (!rest.empty() && !looks_like_gcode(line)) return fmt::format("no such command: '{}'; try 'help'", line);
  if (word == "pause" || word == "p") {
    job.pause(now);
  } else if (word == "resume" || word == "r" || word == "continue") {
    if (job.progress().waits_for_user) {
      job.answer(0, now);
    } else {
      job.resume(now);
    }
  } else if (word == "cancel" || word == "c") {
    job.cancel(now);
  } else if (word == "stop") {
    job.halt(now);
  } else if (word == "objects") {
    return objects_text(job);
  } else if (word == "status") {
    return status(job);
  } else if (word == "help" || word == "?") {
    return kHelp;
  } else if (looks_like_gcode(line)) {
    return send(job, std::string(line));
  } else {
    return fmt::format("no such command: '{}'; try 'help'", line);
  }
  return {};
}

PrintConsole::PrintConsole(bool input_is_print, const std::string& pipe,
                           std::function<void(const std::string&)> say)
    : say_(std::move(say)) {
  if (!input_is_print && isatty(STDIN_FILENO) != 0) terminal_.descriptor = STDIN_FILENO;
  count_interrupts();
  if (pipe.empty()) return;
  struct stat about {};
  if (::stat(pipe.c_str(), &about) != 0 && ::mkfifo(pipe.c_str(), 0600) != 0)
    throw Failure(ExitCode::kUsage, "cannot make the pipe " + pipe + " for --console");
  if (::stat(pipe.c_str(), &about) != 0 || !S_ISFIFO(about.st_mode))
    throw Failure(ExitCode::kUsage, pipe + " is no named pipe, as --console needs one (mkfifo)");
  // For writing, too, so that a writer that goes does not end it.
  pipe_.descriptor = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (pipe_.descriptor < 0)
    throw Failure(ExitCode::kUsage, "cannot open the pipe " + pipe + " for --console");
}

PrintConsole::~PrintConsole() {
  if (pipe_.descriptor >= 0) ::close(pipe_.descriptor);
}

void PrintConsole::steer(PrintJob& job, Instant now) {
  heed_interrupts(job, now);
  take_lines(terminal_, job, now);
  take_lines(pipe_, job, now);
  tell_changes(job);
}

void PrintConsole::take_lines(Input& input, PrintJob& job, Instant now) {
  if (input.descriptor < 0) return;
  pollfd watched{input.descriptor, POLLIN, 0};
  if (::poll(&watched, 1, 0) <= 0 || (watched.revents & POLLIN) == 0) return;
  std::array<char, 1024> bytes{};
  const ssize_t count = ::read(input.descriptor, bytes.data(), bytes.size());
  if (count == 0) input.descriptor = -1;  // the terminal is gone, or Ctrl-D was typed
  if (count <= 0) return;
  input.partial.append(bytes.data(), static_cast<std::size_t>(count));
  while (true) {
    const std::size_t end = input.partial.find('\n');
    if (end == std::string::npos) break;
    const std::string line = input.partial.substr(0, end);
    input.partial.erase(0, end + 1);
    if (const std::string reply = perform(line, job, now); !reply.empty()) say_(reply);
  }
  constexpr std::size_t kMostPartial = 4096;
  if (input.partial.size() > kMostPartial) input.partial.clear();
}

void PrintConsole::heed_interrupts(PrintJob& job, Instant now) {
  const int count = count_interrupts();
  while (interrupts_seen_ < count) {
    ++interrupts_seen_;
    const bool asks = terminal_.descriptor >= 0 && interrupts_seen_ == 1 && count == 1 &&
                      job.progress().phase == JobPhase::kPrinting;
    if (asks) {
      job.pause(now);
      say_("pausing: 'resume' goes on, 'cancel' (or Ctrl-C again) ends the print with the heaters off");
      return;
    }
    if (job.progress().phase == JobPhase::kCancelling) {
      job.halt(now);
    } else if (terminal_.descriptor >= 0 || interrupts_seen_ >= 1) {
      job.cancel(now);
      say_("cancelling; Ctrl-C once more halts the printer at once (M112)");
    }
    // Two at once are a cancel, not a halt.
    if (interrupts_seen_ + 1 == count && count == 2) interrupts_seen_ = count;
  }
}

void PrintConsole::tell_changes(const PrintJob& job) {
  const transport::JobProgress& progress = job.progress();
  const bool waiting = progress.waits_for_user || progress.prompt.shown;
  if (waiting && !std::exchange(told_waiting_, true)) {
    std::string text = "the printer waits for you";
    if (!progress.prompt.text.empty()) text += ": " + progress.prompt.text;
    for (std::size_t button = 0; button < progress.prompt.buttons.size(); ++button)
      text += fmt::format("\n  answer {}  {}", button, progress.prompt.buttons[button]);
    if (progress.prompt.buttons.empty()) text += "; 'resume' lets it go on";
    say_(text);
  }
  if (!waiting) told_waiting_ = false;
  const bool paused = progress.phase == JobPhase::kPaused;
  if (paused && !std::exchange(told_paused_, true)) {
    say_(progress.paused_by == transport::Instigator::kSource
             ? "parked: the slicer is behind; the print goes on by itself"
             : "paused; 'resume' goes on, 'cancel' ends the print");
  }
  if (!paused) told_paused_ = false;
}

}  // namespace lamina::tools
