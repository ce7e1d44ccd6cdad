#include "gcode/gcode_stream.h"

#include <algorithm>
#include <utility>

#include "gcode/marlin/statistics.h"
#include "gcode/motion/toolpath_time.h"
#include "gcode/plan/cooling.h"
#include "gcode/region/layer_region.h"

namespace lamina::gcode {
namespace {

GcodeOptions completed(GcodeOptions options) {
  if (options.plan.speed.travel_z <= 0.0) options.plan.speed.travel_z = options.limits.max_feedrate.z;
  return options;
}

GcodeReader read_all(const std::vector<std::string>& lines, const MachineLimits& limits) {
  GcodeReader reader(limits);
  for (const std::string& line : lines) reader.read(line);
  return reader;
}

}  // namespace

GcodeStream::GcodeStream(const GcodeOptions& options, const PrintOutline& outline)
    : options_(completed(options)),
      writer_(options_, outline),
      header_(writer_.header()),
      start_(read_all(header_, options_.limits)),
      position_(start_.position()),
      planner_(options_.plan, options_.filament, position_),
      machine_(options_.limits) {
  check_fit(outline.bounds, options_.volume, "model");
  writer_.start_at(position_);
  totals_.seconds = start_.summary().seconds;
}

std::vector<std::string> GcodeStream::push(const engine::Layer& layer) {
  LayerRegion region = make_region(layer, options_.region);
  totals_.open_contours += region.open_contours;
  totals_.touch_contours += region.touch_contours;
  totals_.touch_points += region.touch_points;
  totals_.crossing_contours += region.crossing_contours;
  std::vector<std::string> lines;
  write(planner_.push(std::move(region)), lines);
  return lines;
}

std::vector<std::string> GcodeStream::finish() {
  std::vector<std::string> lines;
  write(planner_.finish(), lines);
  for (const TimedSegment& timed : machine_.finish()) add_time(timed);
  for (std::string& line : writer_.end()) lines.push_back(std::move(line));
  for (std::string& line : statistics_lines(options_, totals_)) lines.push_back(std::move(line));
  return lines;
}

void GcodeStream::write(std::vector<LayerToolpath> layers, std::vector<std::string>& lines) {
  for (LayerToolpath& planned : layers) {
    const LayerToolpath layer =
        cooled(std::move(planned), position_, options_.cooling, options_.filament, options_.limits);
    const engine::Box3 bounds = extrusion_bounds(layer, position_);
    check_fit(bounds, options_.volume, "layer " + std::to_string(layer.index) + " with skirt or brim");

    totals_.layer_seconds.push_back(0.0);
    for (const Move& move : layer.moves) {
      Segment segment = segment_of(move, position_, options_.filament);
      segment.tag = totals_.layers;
      if (const auto timed = machine_.push(segment)) add_time(*timed);
      position_ = move.end;
    }
    for (std::string& line : writer_.layer(layer)) lines.push_back(std::move(line));

    ++totals_.layers;
    totals_.volume += volume(layer);
    totals_.narrow_area += layer.narrow_area;
    totals_.filament_length = start_.summary().filament_length + writer_.filament_length();
    if (!bounds.isEmpty()) {
      totals_.bounds.extend(bounds);
      totals_.max_z = std::max(totals_.max_z, bounds.max().z());
    }
  }
}

void GcodeStream::add_time(const TimedSegment& timed) {
  totals_.layer_seconds[timed.tag] += timed.seconds;
  totals_.seconds += timed.seconds;
}

}  // namespace lamina::gcode
