#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/model.h"
#include "engine/pointcloud/front_state.h"

namespace lamina::engine {

/// The model's scanned points by ascending z, and those near a rising plane: for scans what `PatchFront` is
/// for patches.
class ScanFront {
 public:
  explicit ScanFront(const Model& model);

  /// Moves the plane up to z, which must not decrease: points whose surroundings reach to within `reach` of
  /// it become active.
  void advance(double z, double reach);

  std::vector<FrontScan> active() const;

 private:
  struct Scan {
    std::shared_ptr<const ScanField> field;
    std::vector<std::uint32_t> by_z;  ///< points by ascending z
    std::size_t first = 0;            ///< active ones: [first, last) of by_z
    std::size_t last = 0;
  };

  std::vector<Scan> scans_;
};

}  // namespace lamina::engine
