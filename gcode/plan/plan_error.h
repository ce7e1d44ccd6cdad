#pragma once

#include <stdexcept>
#include <string>

namespace lamina::gcode {

/// A layer or an option that toolpaths cannot be planned with.
class PlanError : public std::runtime_error {
 public:
  PlanError(const std::string& what_failed, double wrong_value, double limit, const std::string& problem)
      : std::runtime_error(problem), subject(what_failed), value(wrong_value), bound(limit) {}

  std::string subject;  ///< The option's key, or "layer N".
  double value;
  double bound;
};

}  // namespace lamina::gcode
