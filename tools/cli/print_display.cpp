#include "tools/cli/print_display.h"

#include <iostream>

#include <fmt/format.h>

namespace lamina::tools {
namespace {

using std::chrono::duration;
using transport::JobPhase;
using transport::JobProgress;

constexpr std::chrono::seconds kRateInterval{1};
constexpr std::chrono::seconds kEventInterval{2};

std::string heater_text(const transport::TemperatureReport& temperatures, const char* name,
                        const char* heater) {
  const transport::HeaterReading* const reading = temperatures.find(heater);
  return reading == nullptr ? ""
                            : fmt::format("  {} {:.0f}/{:.0f} C", name, reading->current, reading->target);
}

/// Empty when the print is over.
std::string phase_name(JobPhase phase) {
  switch (phase) {
    case JobPhase::kConnecting:
    case JobPhase::kChecking:
      return "Connecting";
    case JobPhase::kPrinting:
      return "Printing";
    case JobPhase::kPausing:
      return "Parking";
    case JobPhase::kPaused:
      return "Paused";
    case JobPhase::kReturning:
      return "Returning";
    case JobPhase::kFinishing:
      return "Finishing";
    case JobPhase::kCancelling:
      return "Cancelling";
    default:
      return {};
  }
}

/// By time where the file tells, otherwise by its bytes or layers.
double fraction(const JobProgress& progress, const PrintSource& source) {
  return progress.time_fraction.value_or(source.fraction());
}

}  // namespace

PrintDisplay::PrintDisplay(const PrintSource& source, ProgressBar& bar, const transport::Window& window,
                           bool events)
    : source_(source), bar_(bar), window_(window), events_(events) {}

void PrintDisplay::update(const JobProgress& progress) {
  measure_rate(progress);
  if (const std::string phase = phase_name(progress.phase); !phase.empty() && phase != phase_) {
    phase_ = phase;
    bar_.begin(phase);
    if (events_) emit({{"event", "phase"}, {"phase", phase}});
  }
  std::optional<double> left = progress.seconds_left;
  if (const std::optional<double> total = source_.header().seconds; total && !left)
    left = *total * (1.0 - fraction(progress, source_));
  bar_.update(fraction(progress, source_), detail(progress), left);
  if (!events_) return;
  if (progress.layer != layer_) {
    layer_ = progress.layer;
    emit({{"event", "layer"},
          {"layer", layer_},
          {"height_mm", progress.height ? Json(*progress.height) : Json()}});
  }
  if (const Clock::time_point now = Clock::now(); now - told_ >= kEventInterval) {
    told_ = now;
    emit_progress(progress);
  }
}

void PrintDisplay::say(const std::string& text) {
  bar_.say(text);
  if (events_) emit({{"event", "message"}, {"text", text}});
}

void PrintDisplay::measure_rate(const JobProgress& progress) {
  const Clock::time_point now = Clock::now();
  if (now - measured_ < kRateInterval) return;
  const double seconds = duration<double>(now - measured_).count();
  lines_a_second_ = static_cast<double>(progress.job_lines_acknowledged - lines_then_) / seconds;
  lines_then_ = progress.job_lines_acknowledged;
  measured_ = now;
}

std::string PrintDisplay::detail(const JobProgress& progress) const {
  std::string text = fmt::format("line {}", progress.job_lines_acknowledged);
  const auto layers =
      progress.layer_count > 0 ? progress.layer_count : static_cast<std::int64_t>(source_.layer_count());
  if (layers > 0) text += fmt::format("  layer {}/{}", progress.layer, layers);
  text += heater_text(progress.temperatures, "nozzle", "T") + heater_text(progress.temperatures, "bed", "B");
  text += fmt::format("  {:.0f} lines/s", lines_a_second_);
  text += progress.cautious ? "  window 1" : fmt::format("  window {}", window_.lines);
  if (progress.planner_free) text += fmt::format("  planner {} free", *progress.planner_free);
  if (progress.wire.resends > 0) text += fmt::format("  {} resends", progress.wire.resends);
  return text;
}

void PrintDisplay::emit(const Json& event) const {
  std::cout << to_line(event) << std::endl;
}

void PrintDisplay::emit_progress(const JobProgress& progress) const {
  Json temperatures = Json::object();
  for (const transport::HeaterReading& reading : progress.temperatures.heaters)
    temperatures[reading.heater] = {{"current", reading.current}, {"target", reading.target}};
  Json event{{"event", "progress"},
             {"fraction", fraction(progress, source_)},
             {"line", progress.job_lines_acknowledged},
             {"source_line", progress.source_lines},
             {"source_bytes", progress.source_bytes},
             {"layer", progress.layer},
             {"temperatures", temperatures},
             {"lines_a_second", lines_a_second_},
             {"window", progress.cautious ? 1 : window_.lines},
             {"resends", progress.wire.resends},
             {"probes", progress.wire.probes}};
  if (progress.seconds_left) event["seconds_left"] = *progress.seconds_left;
  if (progress.planner_free) event["planner_free"] = *progress.planner_free;
  emit(event);
}

}  // namespace lamina::tools
