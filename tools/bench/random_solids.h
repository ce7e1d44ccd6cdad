#pragma once

#include <random>
#include <string>
#include <vector>

#include "engine/model.h"

namespace lamina::tools {

/// Closed solids that may overlap, and all their surfaces as one model.
struct RandomSolid {
  engine::Model model;
  std::vector<engine::Model> parts;
};

/// Spheres, boxes, tori, B-spline vases, extrusions and blobs of some millimetres in random poses, one to
/// three together.
class RandomSolids {
 public:
  explicit RandomSolids(unsigned seed) : random_(seed) {}

  RandomSolid next(int index);

 private:
  double number(double low, double high);
  engine::Model solid(int kind);
  engine::Model vase();
  engine::Model extrusion();
  engine::Model blob();
  engine::Model posed(const engine::Model& model);

  std::mt19937 random_;
};

}  // namespace lamina::tools
