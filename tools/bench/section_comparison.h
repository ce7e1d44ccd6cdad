#pragma once

#include <filesystem>
#include <vector>

#include "tools/bench/corpus_models.h"

namespace lamina::tools {

struct SectionNumbers {
  double area = 0.0;        ///< mm^2
  double contours = 0.0;    ///< closed ones
  double open_lines = 0.0;  ///< that bound nothing
};

/// One height of one model.
struct SectionComparison {
  double z = 0.0;  ///< mm
  SectionNumbers ours;
  SectionNumbers curves;     ///< of OpenCASCADE: of plane and faces
  SectionNumbers triangles;  ///< of OpenCASCADE: of its triangles of the same faces
};

/// How many heights a model is cut at.
inline constexpr int kSectionHeights = 12;

/// Cuts a file as lamina reads it and as OpenCASCADE reads it, which works in a process of its own. With a
/// folder for `pictures` both are drawn. Throws std::runtime_error when OpenCASCADE cannot read the file,
/// crashes or needs longer than five minutes.
std::vector<SectionComparison> compare_sections(const CorpusModel& file,
                                                const std::filesystem::path& pictures);

}  // namespace lamina::tools
