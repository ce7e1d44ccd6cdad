#include <iostream>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "tools/cli/failure.h"
#include "tools/cli/json.h"
#include "tools/cli/verbs.h"
#include "transport/trace/replay.h"
#include "transport/trace/trace_file.h"

namespace lamina::tools {
namespace {

struct ReplayArguments {
  std::string trace;
  bool json = false;
};

transport::Trace read(const std::string& path) {
  try {
    return transport::read_trace(path);
  } catch (const std::system_error& error) {
    throw Failure(ExitCode::kInput, error.what());
  } catch (const transport::TraceError& error) {
    throw Failure(ExitCode::kInput, path + ": " + error.what());
  }
}

double seconds_of(transport::Instant at) {
  return transport::to_seconds(at.time_since_epoch());
}

/// What the engine had to say at the end, if it came to one.
std::string ending(const transport::ReplayResult& result) {
  for (const transport::ReplayEvent& replayed : result.events) {
    if (const auto* ended = std::get_if<transport::Ended>(&replayed.event))
      return fmt::format("at {:.6f} s: {}", seconds_of(replayed.at), ended->detail);
  }
  return {};
}

Json to_json(const transport::ReplayResult& result) {
  const transport::EngineStatistics& statistics = result.statistics;
  Json json{{"same", !result.difference},
            {"seconds", transport::to_seconds(result.span)},
            {"bytes_sent", result.bytes_sent},
            {"bytes_received", result.bytes_received},
            {"lines_sent", statistics.lines_sent},
            {"lines_sent_again", statistics.lines_sent_again},
            {"lines_acknowledged", statistics.lines_acknowledged},
            {"resends", statistics.resends},
            {"probes", statistics.probes},
            {"stray_replies", statistics.stray_replies}};
  if (const std::string end = ending(result); !end.empty()) json["ended"] = end;
  if (result.difference) {
    json["difference"] = {{"seconds", seconds_of(result.difference->at)},
                          {"position", result.difference->position},
                          {"before", transport::escaped(result.difference->before)},
                          {"traced", transport::escaped(result.difference->traced)},
                          {"replayed", transport::escaped(result.difference->replayed)}};
  }
  return json;
}

void say(const transport::ReplayResult& result) {
  const transport::EngineStatistics& statistics = result.statistics;
  std::cout << fmt::format(
      "{}: {:.3f} s, {} bytes sent, {} received\n"
      "  lines     {} sent, {} acknowledged, {} sent again\n"
      "  trouble   {} resends, {} probes, {} stray replies\n",
      result.difference ? "differs" : "same", transport::to_seconds(result.span), result.bytes_sent,
      result.bytes_received, statistics.lines_sent, statistics.lines_acknowledged,
      statistics.lines_sent_again, statistics.resends, statistics.probes, statistics.stray_replies);
  if (const std::string end = ending(result); !end.empty()) std::cout << "  ended     " << end << '\n';
  if (!result.difference) return;
  const auto shown = [](const std::string& bytes) {
    return bytes.empty() ? "(nothing)" : transport::escaped(bytes);
  };
  std::cout << fmt::format(
      "  first difference at {:.6f} s, byte {} of what was sent\n"
      "  before    {}\n  trace     {}\n  engine    {}\n",
      seconds_of(result.difference->at), result.difference->position, shown(result.difference->before),
      shown(result.difference->traced), shown(result.difference->replayed));
}

ExitCode run(const ReplayArguments& arguments) {
  const transport::ReplayResult result = transport::replay(read(arguments.trace));
  if (arguments.json) {
    std::cout << to_text(to_json(result)) << '\n';
  } else {
    say(result);
  }
  return result.difference ? ExitCode::kInternal : ExitCode::kOk;
}

}  // namespace

Verb replay_verb() {
  const auto arguments = std::make_shared<ReplayArguments>();
  return {"replay", "Replay the trace of a print: does the program still send what it sent then? (1: no)",
          "  lamina replay print.trace            written by lamina print part.gcode --port ... --trace "
          "print.trace\n"
          "  lamina replay print.trace --json",
          [arguments](OptionSet& options) {
            options.argument("TRACE", arguments->trace, "File that 'lamina print --trace' has written");
            options.flag("--json", arguments->json, "Print the result as JSON");
          },
          [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
