#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/model.h"
#include "engine/slice_plane.h"

namespace lamina::tools {

/// A model of the corpus that can be sliced.
struct CorpusModel {
  std::string name;  ///< file within the corpus, such as seed/torus.igs
  std::filesystem::path file;
};

/// The files of the corpus with one of these extensions whose path contains one of `parts` (all when empty),
/// by name. Empty when the corpus is not there.
std::vector<CorpusModel> corpus_models(const std::filesystem::path& corpus,
                                       const std::vector<std::string>& parts,
                                       const std::vector<std::string>& extensions = {".igs", ".iges"});

/// The dissertation's planes: at the bottom of every layer, from the lowest point of the model on.
std::vector<engine::SlicePlane> dissertation_planes(const engine::Model& model, double lambda);

}  // namespace lamina::tools
