#include "tools/bench/corpus_models.h"

#include <algorithm>

#include "engine/model_bounds.h"
#include "engine/slicing_planes.h"

namespace lamina::tools {

std::vector<CorpusModel> corpus_models(const std::filesystem::path& corpus,
                                       const std::vector<std::string>& parts,
                                       const std::vector<std::string>& extensions) {
  std::vector<CorpusModel> models;
  if (!std::filesystem::is_directory(corpus)) return models;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus)) {
    const std::string extension = entry.path().extension().string();
    if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) continue;
    const std::string name = std::filesystem::relative(entry.path(), corpus).generic_string();
    const bool wanted =
        parts.empty() || std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
          return name.find(part) != std::string::npos;
        });
    if (wanted) models.push_back({name, entry.path()});
  }
  std::sort(models.begin(), models.end(),
            [](const CorpusModel& a, const CorpusModel& b) { return a.name < b.name; });
  return models;
}

std::vector<engine::SlicePlane> dissertation_planes(const engine::Model& model, double lambda) {
  const engine::Box3 bounds = engine::model_bounds(model);
  engine::SlicingPlanesOptions options;
  options.layer_thickness = lambda;
  options.position = engine::SlicePosition::kBottom;
  return engine::make_slicing_planes(bounds.min().z(), bounds.max().z(), options);
}

}  // namespace lamina::tools
