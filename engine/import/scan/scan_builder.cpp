#include "engine/import/scan/scan_builder.h"

#include <utility>

#include <fmt/format.h>

#include "engine/import/import_error.h"
#include "engine/import/mesh/coordinate.h"

namespace lamina::engine {

void ScanBuilder::add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  if (!is_usable(point)) {
    ++without_place_;
    return;
  }
  scanned_.points.push_back(point);
  scanned_.normals.push_back(normal);
}

ImportResult ScanBuilder::finish(std::string format, bool has_normals) {
  const std::size_t given = scanned_.points.size();
  if (!has_normals) scanned_.normals.clear();
  PreparedScan prepared = prepare_scan(std::move(scanned_));
  if (prepared.cloud.points.size() < kFewestScanPoints) {
    throw ImportError(
        {.file = file_},
        fmt::format("nothing to slice: the file holds {} points without faces, {} of them usable; "
                    "a scan must have {} at least",
                    given + without_place_, prepared.cloud.points.size(), kFewestScanPoints));
  }
  const auto note = [&](std::string_view what, std::size_t count) {
    if (count > 0) log_.note(what, "file", 0, fmt::format("{} points", count));
  };
  note("points without a position, left out", without_place_);
  note("points given more than once", prepared.repeated);
  note("points far from the surface of their neighbours, left out", prepared.outliers);
  if (has_normals && prepared.estimated_normals)
    log_.note("normals that contradict each other, made anew", "file", 0);

  ImportResult result;
  result.model.name = file_;
  result.report.format = std::move(format);
  result.report.entities = {{0, "point", given}};
  result.report.tolerated = log_.list();
  result.model.clouds.push_back(std::move(prepared.cloud));
  return result;
}

}  // namespace lamina::engine
