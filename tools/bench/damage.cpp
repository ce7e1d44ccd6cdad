#include "tools/bench/damage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <locale>
#include <set>
#include <sstream>
#include <stdexcept>

#include "engine/geometry/segment_distance.h"
#include "engine/import/read_model.h"

namespace lamina::tools {
namespace {

constexpr double kMargin = 0.1;  // mm
constexpr const char* kBroken = "_broken";
constexpr const char* kClean = "_clean";

engine::Box3 grown(const engine::Box3& box, double by) {
  const engine::Vector3 margin = engine::Vector3::Constant(by);
  return {box.min() - margin, box.max() + margin};
}

/// A facet's corners, the least first.
using Corners = std::array<std::array<float, 3>, 3>;

std::set<Corners> facets_of(const engine::Model& model) {
  std::set<Corners> facets;
  for (const engine::TriangleMesh& mesh : model.meshes) {
    for (const std::array<std::uint32_t, 3>& facet : mesh.facets) {
      Corners corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3f& place = mesh.vertices[facet[k]];
        corners[k] = {place.x(), place.y(), place.z()};
      }
      std::sort(corners.begin(), corners.end());
      facets.insert(corners);
    }
  }
  return facets;
}

void add_facets(const std::set<Corners>& facets, const std::set<Corners>& of_other, const char* defect,
                std::vector<Damage>& damage) {
  std::vector<Corners> without_other;
  std::set_difference(facets.begin(), facets.end(), of_other.begin(), of_other.end(),
                      std::back_inserter(without_other));
  for (const Corners& corners : without_other) {
    Triangle triangle;
    engine::Box3 box;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = engine::Vector3(corners[k][0], corners[k][1], corners[k][2]);
      box.extend(triangle[k]);
    }
    damage.push_back({defect, grown(box, kMargin), triangle});
  }
}

double distance_to_triangle(const engine::Vector3& place, const Triangle& corners) {
  const engine::Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  bool above = normal.squaredNorm() > 0.0;
  double to_sides = (place - corners[0]).norm();
  for (std::size_t k = 0; k < 3; ++k) {
    const engine::Vector3& from = corners[k];
    const engine::Vector3& to = corners[(k + 1) % 3];
    to_sides = std::min(to_sides, std::sqrt(engine::squared_distance(place, from, to)));
    above = above && (to - from).cross(place - from).dot(normal) >= 0.0;
  }
  return above ? std::abs((place - corners[0]).dot(normal)) / normal.norm() : to_sides;
}

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
    std::string defect;
    std::size_t number = 0;
    double amount = 0.0;  // mm
    if (!(words >> defect >> number >> amount) || number == 0 || number > model.surfaces.size()) {
      throw std::runtime_error(list.string() + ": cannot read \"" + line + "\"");
    }
    const engine::Box3 box = engine::control_box(model.surfaces[number - 1].nurbs.net);
    damage.push_back({defect, grown(box, amount + kMargin)});
  }
  return damage;
}

std::vector<Damage> facet_damage(const engine::Model& broken, const engine::Model& clean) {
  const std::set<Corners> of_broken = facets_of(broken);
  const std::set<Corners> of_clean = facets_of(clean);
  std::vector<Damage> damage;
  add_facets(of_clean, of_broken, "facet-lost", damage);
  add_facets(of_broken, of_clean, "facet-added", damage);
  return damage;
}

std::vector<Damage> damage_of(const std::filesystem::path& model_file, const engine::Model& model) {
  std::vector<Damage> damage = listed_damage(model_file, model);
  std::string stem = model_file.stem().string();
  const std::size_t ending = stem.rfind(kBroken);
  if (ending == std::string::npos || ending + std::string(kBroken).size() != stem.size()) return damage;
  std::filesystem::path twin = model_file;
  twin.replace_filename(stem.replace(ending, std::string::npos, kClean) + model_file.extension().string());
  if (!std::filesystem::exists(twin)) return damage;
  const std::vector<Damage> of_facets = facet_damage(model, engine::read_model(twin).model);
  damage.insert(damage.end(), of_facets.begin(), of_facets.end());
  return damage;
}

bool is_damaged(const std::vector<Damage>& damage, const engine::Vector3& place) {
  return std::any_of(damage.begin(), damage.end(), [&](const Damage& found) {
    return found.box.contains(place) &&
           (!found.facet || distance_to_triangle(place, *found.facet) <= kMargin);
  });
}

}  // namespace lamina::tools
