#pragma once

#include <functional>
#include <vector>

#include "engine/layer.h"
#include "engine/model.h"
#include "engine/slice_options.h"
#include "engine/slice_plane.h"
#include "tools/bench/child_run.h"

namespace lamina::tools {

/// One slicing of a whole model.
struct SliceRun {
  double seconds = 0.0;      ///< from the model in memory to the last layer, on the wall's clock
  double cpu_seconds = 0.0;  ///< the same of all threads together: what others do on the machine counts less
  double layers = 0.0;
  double length = 0.0;  ///< of all contours, mm
  double control_points = 0.0;
  double peak_megabytes = 0.0;  ///< of the process, where it ran in one of its own
};

/// Slices with lamina's engine and throws every layer away. Measuring the lengths is not counted as time.
SliceRun slice_once(const engine::Model& model, const std::vector<engine::SlicePlane>& planes,
                    const engine::SliceOptions& options);

/// The same with the dense method; `lambda` sets the size of its patches.
SliceRun slice_densely_once(const engine::Model& model, const std::vector<engine::SlicePlane>& planes,
                            double lambda, double epsilon);

/// Runs one of these in a process of its own, which makes the model as well.
SliceRun measured_apart(const std::function<SliceRun()>& run);

/// The exponent p of value = c size^p, by least squares of the logarithms.
double fitted_exponent(const std::vector<double>& sizes, const std::vector<double>& values);

double middle_of(std::vector<double> values);

}  // namespace lamina::tools
