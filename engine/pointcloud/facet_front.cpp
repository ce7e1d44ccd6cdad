#include "engine/pointcloud/facet_front.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lamina::engine {

FacetFront::FacetFront(const Model& model) : meshes_(model.meshes) {
  struct Start {
    float z;
    Place place;
  };
  std::vector<Start> starts;
  for (std::uint32_t m = 0; m < meshes_.size(); ++m) {
    for (std::uint32_t f = 0; f < meshes_[m].facets.size(); ++f) {
      const Place place{m, f};
      starts.push_back({lowest(place), place});
    }
  }
  std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) {
    return std::tie(a.z, a.place.mesh, a.place.facet) < std::tie(b.z, b.place.mesh, b.place.facet);
  });
  places_.reserve(starts.size());
  for (const Start& start : starts) places_.push_back(start.place);
}

const Eigen::Vector3f& FacetFront::corner(const Place& place, std::size_t k) const {
  const TriangleMesh& mesh = meshes_[place.mesh];
  return mesh.vertices[mesh.facets[place.facet][k]];
}

float FacetFront::lowest(const Place& place) const {
  return std::min({corner(place, 0).z(), corner(place, 1).z(), corner(place, 2).z()});
}

float FacetFront::highest(const Place& place) const {
  return std::max({corner(place, 0).z(), corner(place, 1).z(), corner(place, 2).z()});
}

void FacetFront::advance(double z, double reach) {
  const auto passed = [&](const Place& place) { return static_cast<double>(highest(place)) < z - reach; };
  removed_ = std::erase_if(active_, passed);
  added_ = 0;
  for (; next_ < places_.size() && static_cast<double>(lowest(places_[next_])) <= z + reach; ++next_) {
    if (passed(places_[next_])) continue;  // between two planes: never met
    active_.push_back(places_[next_]);
    ++added_;
  }
}

std::vector<FrontFacet> FacetFront::active() const {
  std::vector<FrontFacet> facets;
  facets.reserve(active_.size());
  for (const Place& place : active_) {
    facets.push_back({{corner(place, 0), corner(place, 1), corner(place, 2)}, place.mesh});
  }
  return facets;
}

}  // namespace lamina::engine
