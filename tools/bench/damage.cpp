#include "tools/bench/damage.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lamina::tools {
namespace {

constexpr double kMargin = 0.1;  // mm

}  // namespace

std::vector<Damage> listed_damage(const std::filesystem::path& model_file, const engine::Model& model) {
  std::filesystem::path list = model_file;
  list.replace_extension(".defects.txt");
  std::vector<Damage> damage;
  std::ifstream file(list);
  file.imbue(std::locale::classic());
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    Damage found;
    std::size_t number = 0;
    if (!(words >> found.defect >> number >> found.amount) || number == 0 || number > model.surfaces.size()) {
      throw std::runtime_error(list.string() + ": cannot read \"" + line + "\"");
    }
    found.surface = number - 1;
    found.box = engine::control_box(model.surfaces[found.surface].nurbs.net);
    const engine::Vector3 margin = engine::Vector3::Constant(found.amount + kMargin);
    found.box = engine::Box3(found.box.min() - margin, found.box.max() + margin);
    damage.push_back(found);
  }
  return damage;
}

bool is_damaged(const std::vector<Damage>& damage, const engine::Vector3& place) {
  return std::any_of(damage.begin(), damage.end(),
                     [&](const Damage& found) { return found.box.contains(place); });
}

}  // namespace lamina::tools
