#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/import/iges/tolerance_log.h"

namespace lamina::engine {

/// What the global section says; defaults are those of the standard (IGES 5.3, section 2.2.4.3).
struct GlobalSection {
  char parameter_delimiter = ',';
  char record_delimiter = ';';
  std::string product;
  std::string system;
  std::string preprocessor;
  double model_scale = 1.0;  ///< positive
  int unit_flag = 0;         ///< 0 where the field is empty
  std::string unit_name;
  double resolution = 0.0;      ///< file units; 0 where it is not given
  double max_coordinate = 0.0;  ///< file units; 0 where it is not given
  std::string author;
  std::string organization;
};

/// Reads the lines of the global section. Strings with a wrong count are cut at the next delimiter and noted.
/// Throws ImportError, naming `file`, where the section is missing or its numbers make no sense.
GlobalSection parse_global_section(const std::vector<std::string_view>& lines, const std::string& file,
                                   ToleranceLog& log);

}  // namespace lamina::engine
