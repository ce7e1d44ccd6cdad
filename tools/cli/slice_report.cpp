#include "tools/cli/slice_report.h"

#include <algorithm>
#include <cmath>

#include <sys/resource.h>

#include "engine/nurbs/bezier.h"

namespace lamina::tools {
namespace {

constexpr double kKilobytesInMegabyte = 1024.0;

double longest_line(const engine::ControlNet& net, bool along_u) {
  const std::size_t lines = along_u ? net.count_v : net.count_u;
  const std::size_t count = along_u ? net.count_u : net.count_v;
  double longest = 0.0;
  for (std::size_t line = 0; line < lines; ++line) {
    double length = 0.0;
    for (std::size_t k = 1; k < count; ++k) {
      const engine::Vector4& a = along_u ? net.at(k - 1, line) : net.at(line, k - 1);
      const engine::Vector4& b = along_u ? net.at(k, line) : net.at(line, k);
      length += (b.head<3>() / b.w() - a.head<3>() / a.w()).norm();
    }
    longest = std::max(longest, length);
  }
  return longest;
}

double length_of(const engine::Layer& layer) {
  double length = 0.0;
  for (const engine::ClosedContour& contour : layer.closed) length += engine::length(contour.curve);
  for (const engine::OpenContour& contour : layer.open) length += engine::length(contour.curve);
  for (const engine::PlanarContour& contour : layer.planar) {
    length += engine::length(contour.outer);
    for (const engine::PieceCurve& inner : contour.inner) length += engine::length(inner);
  }
  return length;
}

Json gaps_json(const std::vector<engine::BridgedGap>& gaps) {
  Json json = Json::array();
  for (const engine::BridgedGap& gap : gaps) {
    json.push_back({{"width_mm", gap.width()},
                    {"from_mm", {gap.from.x(), gap.from.y()}},
                    {"to_mm", {gap.to.x(), gap.to.y()}}});
  }
  return json;
}

Json row_json(const SliceReportRow& row) {
  const engine::LayerReport& report = row.report;
  return {{"index", row.index},
          {"z_mm", row.z},
          {"length_mm", row.length},
          {"patches", report.active_patches},
          {"patches_added", report.patches_added},
          {"patches_removed", report.patches_removed},
          {"facets", report.active_facets},
          {"cells", report.cells},
          {"unresolved_cells", report.unresolved_cells},
          {"arcs", report.arcs},
          {"points", report.nodes},
          {"branchings", report.branchings},
          {"tiles", report.tiles},
          {"shared_cells", report.shared_cells},
          {"close_places", report.close_places},
          {"meetings", report.meetings},
          {"resolved_contours", report.resolved_contours},
          {"components", report.components},
          {"control_points", report.control_points},
          {"greatest_fit_distance_mm", report.greatest_fit_distance},
          {"bridged_gaps", gaps_json(report.bridged_gaps)},
          {"open_gaps", gaps_json(report.open_gaps)},
          {"dropped_pieces", report.dropped_pieces},
          {"dropped_length_mm", report.dropped_length},
          {"contained_touches", report.contained_touches},
          {"seconds",
           {{"section", report.seconds.section},
            {"contours", report.seconds.contours},
            {"fit", report.seconds.fit}}}};
}

}  // namespace

PatchFigures patch_figures(const engine::Model& model) {
  PatchFigures figures;
  figures.surfaces = model.surfaces.size();
  double sum = 0.0;
  double square_sum = 0.0;
  for (const engine::Surface& surface : model.surfaces) {
    for (const engine::BezierPatch& patch : engine::bezier_patches(surface.nurbs)) {
      const double extent = 0.5 * (longest_line(patch.net, true) + longest_line(patch.net, false));
      sum += extent;
      square_sum += extent * extent;
      ++figures.patches;
    }
  }
  if (figures.patches == 0) return figures;
  const auto count = static_cast<double>(figures.patches);
  figures.average_extent = sum / count;
  figures.extent_deviation =
      std::sqrt(std::max(0.0, square_sum / count - figures.average_extent * figures.average_extent));
  return figures;
}

void SliceReport::add(const engine::Layer& layer) {
  layers.push_back({layer.index, layer.plane.z, length_of(layer), layer.report});
}

StageTotals SliceReport::stage_seconds() const {
  StageTotals totals;
  for (const SliceReportRow& row : layers) {
    totals.section += row.report.seconds.section;
    totals.contours += row.report.seconds.contours;
    totals.fit += row.report.seconds.fit;
  }
  totals.front = std::max(0.0, seconds - totals.section - totals.contours - totals.fit);
  return totals;
}

Json to_json(const SliceReport& report) {
  const StageTotals stages = report.stage_seconds();
  Json layers = Json::array();
  for (const SliceReportRow& row : report.layers) layers.push_back(row_json(row));
  return {{"model", report.model},
          {"epsilon_mm", report.epsilon},
          {"layer_thickness_mm", report.layer_thickness},
          {"surfaces", report.patches.surfaces},
          {"patches", report.patches.patches},
          {"average_extent_mm", report.patches.average_extent},
          {"extent_deviation_mm", report.patches.extent_deviation},
          {"seconds", report.seconds},
          {"stage_seconds",
           {{"front", stages.front},
            {"section", stages.section},
            {"contours", stages.contours},
            {"fit", stages.fit}}},
          {"peak_megabytes", report.peak_megabytes},
          {"layers", std::move(layers)}};
}

double peak_megabytes_so_far() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / kKilobytesInMegabyte;
}

}  // namespace lamina::tools
