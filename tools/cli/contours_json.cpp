#include "tools/cli/contours_json.h"

#include "tools/cli/json.h"

namespace lamina::tools {

std::string ContoursJson::begin(const engine::Model& model, double tolerance) {
  return "{\"model\":" + to_line(model.name) + ",\"tolerance_mm\":" + to_line(tolerance) + ",\"layers\":[";
}

std::string ContoursJson::layer(const LayerFigures& figures) {
  const Json json{{"layer", figures.index},
                  {"z", figures.z},
                  {"area", figures.area},
                  {"length", figures.length},
                  {"closed", figures.closed},
                  {"open", figures.open},
                  {"planar_outer", figures.planar_outer},
                  {"planar_inner", figures.planar_inner},
                  {"points", figures.points},
                  {"touch", figures.touch}};
  const std::string separator = first_ ? "\n" : ",\n";
  first_ = false;
  return separator + to_line(json);
}

}  // namespace lamina::tools
