#pragma once

#include <string>
#include <vector>

namespace lamina::tools {

/// One of the dissertation's six test models: its name there, the number of its table of results, and the
/// corpus file that stands for it.
struct DissertationModel {
  std::string name;
  std::string table;
  std::string corpus_file;
};

inline std::vector<DissertationModel> dissertation_models() {
  return {{"Human Vertebra", "7.1", "seed/vertebra504.igs"},
          {"Skull Mask", "7.2", "seed/skullmask1260.igs"},
          {"Sculpture Bust", "7.3", "seed/bust601_gaps.igs"},
          {"Torus", "7.4", "seed/torus.igs"},
          {"Trefoil Knot", "7.5", "seed/trefoil_swept.igs"},
          {"Three Characters Initial", "7.6", "seed/initials_WEO.igs"}};
}

}  // namespace lamina::tools
