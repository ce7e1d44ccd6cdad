#pragma once

#include <cstddef>
#include <string>

#include "engine/import/breach_log.h"
#include "engine/import/import_result.h"
#include "engine/scan/prepare_scan.h"

namespace lamina::engine {

/// Collects the points of a file and makes a model of them.
class ScanBuilder {
 public:
  /// Both must outlive the builder.
  ScanBuilder(const std::string& file, BreachLog& log) : file_(file), log_(log) {}

  /// Points without a position, as scanners give them where they saw nothing, are left out and counted.
  void add(const Eigen::Vector3f& point) { add(point, Eigen::Vector3f::Zero()); }
  void add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal);

  /// The model, mm. Throws ImportError where too few points are left.
  ImportResult finish(std::string format, bool has_normals);

 private:
  const std::string& file_;
  BreachLog& log_;
  ScannedPoints scanned_;
  std::size_t without_place_ = 0;
};

}  // namespace lamina::engine
