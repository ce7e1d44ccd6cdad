#pragma once

#include <string>

#include "engine/model.h"
#include "tools/cli/layer_figures.h"

namespace lamina::tools {

/// The layers' figures as one JSON document, written layer by layer: {"model": ..., "layers": [{...}, ...]}.
class ContoursJson {
 public:
  static std::string begin(const engine::Model& model, double tolerance);
  std::string layer(const LayerFigures& figures);
  static std::string end() { return "\n]}\n"; }

 private:
  bool first_ = true;
};

}  // namespace lamina::tools
