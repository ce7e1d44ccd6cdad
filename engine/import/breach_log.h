#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/import/import_report.h"

namespace lamina::engine {

/// Counts tolerated breaches of a format by their description and keeps the place of the first of each.
class BreachLog {
 public:
  /// `section` and `line` say where, such as "facet" and its number; `detail` is kept from the first time.
  void note(std::string_view what, std::string_view section, std::size_t line, std::string_view detail = {});

  /// In the order in which they first occurred.
  const std::vector<ToleratedBreach>& list() const { return breaches_; }

 private:
  std::vector<ToleratedBreach> breaches_;
  std::vector<std::string_view> kinds_;  ///< literals: `what` of each breach
};

}  // namespace lamina::engine
