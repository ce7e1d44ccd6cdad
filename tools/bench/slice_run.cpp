#include "tools/bench/slice_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "engine/slicer.h"
#include "tests/reference/as_engine_layer.h"
#include "tests/reference/reference_slicer.h"
#include "tools/bench/contour_distance.h"

namespace lamina::tools {
namespace {

/// Adds up the time between start and stop.
class StopWatch {
 public:
  void start() {
    wall_start_ = std::chrono::steady_clock::now();
    cpu_start_ = cpu_now();
  }
  void stop(SliceRun& run) const {
    run.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start_).count();
    run.cpu_seconds += cpu_now() - cpu_start_;
  }

 private:
  static double cpu_now() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  std::chrono::steady_clock::time_point wall_start_;
  double cpu_start_ = 0.0;
};

double length_of(const engine::Layer& layer) {
  double length = 0.0;
  for (const engine::PieceCurve* curve : curves_of(layer)) length += engine::length(*curve);
  return length;
}

}  // namespace

SliceRun slice_once(const engine::Model& model, const std::vector<engine::SlicePlane>& planes,
                    const engine::SliceOptions& options) {
  SliceRun run;
  StopWatch watch;
  watch.start();
  engine::Slicer slicer(model, planes, options);
  while (const auto layer = slicer.next()) {
    watch.stop(run);
    run.layers += 1.0;
    run.length += length_of(*layer);
    run.control_points += static_cast<double>(layer->report.control_points);
    watch.start();
  }
  watch.stop(run);
  return run;
}

SliceRun slice_densely_once(const engine::Model& model, const std::vector<engine::SlicePlane>& planes,
                            double lambda, double epsilon) {
  reference::SliceOptions options;
  options.layer_thickness = lambda;
  options.epsilon = epsilon;
  SliceRun run;
  StopWatch watch;
  watch.start();
  reference::ReferenceSlicer slicer(model, planes, options);
  while (const auto layer = slicer.next()) {
    watch.stop(run);
    run.layers += 1.0;
    run.length += length_of(reference::as_engine_layer(*layer));
    run.control_points += static_cast<double>(layer->report.control_points);
    watch.start();
  }
  watch.stop(run);
  return run;
}

SliceRun measured_apart(const std::function<SliceRun()>& run) {
  const ChildRun child = run_in_child([&] {
    const SliceRun done = run();
    return std::vector<double>{done.seconds, done.cpu_seconds, done.layers, done.length, done.control_points};
  });
  return {child.values.at(0), child.values.at(1), child.values.at(2),
          child.values.at(3), child.values.at(4), child.peak_megabytes};
}

double fitted_exponent(const std::vector<double>& sizes, const std::vector<double>& values) {
  const auto count = static_cast<double>(sizes.size());
  double x_sum = 0.0;
  double y_sum = 0.0;
  double xx_sum = 0.0;
  double xy_sum = 0.0;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const double x = std::log(sizes[k]);
    const double y = std::log(values[k]);
    x_sum += x;
    y_sum += y;
    xx_sum += x * x;
    xy_sum += x * y;
  }
  return (count * xy_sum - x_sum * y_sum) / (count * xx_sum - x_sum * x_sum);
}

double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace lamina::tools
