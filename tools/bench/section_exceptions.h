#pragma once

#include <string>
#include <vector>

namespace lamina::tools {

/// Heights of one file at which OpenCASCADE's curves give another section, and why.
struct SectionException {
  std::string file;          ///< within the corpus, such as real/hammer.iges
  std::vector<int> heights;  ///< numbers from 0, the lowest
  /// Whether OpenCASCADE's own triangles have the area that lamina has: then its curves are wrong.
  bool triangles_agree = false;
  std::string reason;
};

const std::vector<SectionException>& section_exceptions();

}  // namespace lamina::tools
