#include <iostream>
#include <memory>

#include <fmt/format.h>

#include "engine/import/inspect/boundary_report.h"
#include "engine/import/read_model.h"
#include "engine/model_bounds.h"
#include "engine/nurbs/bezier.h"
#include "engine/scan/prepare_scan.h"
#include "engine/slicer.h"
#include "tools/cli/json.h"
#include "tools/cli/model_input.h"
#include "tools/cli/verbs.h"

namespace lamina::tools {
namespace {

struct InfoArguments {
  std::string model;
  bool json = false;
};

std::size_t patch_count(const engine::Model& model) {
  std::size_t count = 0;
  for (const engine::Surface& surface : model.surfaces) count += engine::bezier_patches(surface.nurbs).size();
  return count;
}

std::size_t trimmed_count(const engine::Model& model) {
  std::size_t count = 0;
  for (const engine::Surface& surface : model.surfaces) count += surface.trim.empty() ? 0U : 1U;
  return count;
}

std::size_t facet_count(const engine::Model& model) {
  std::size_t count = 0;
  for (const engine::TriangleMesh& mesh : model.meshes) count += mesh.facets.size();
  return count;
}

Json point_json(const engine::Vector3& point) {
  return Json::array({point.x(), point.y(), point.z()});
}

/// How the faces meet, and what they bound.
Json boundary_json(const engine::BoundaryReport& boundary) {
  Json json{{"closed", boundary.is_closed()},
            {"edges", boundary.edges},
            {"open_edges", boundary.open_edges},
            {"largest_gap_mm", boundary.largest_gap},
            {"joined_within_mm", boundary.joined_within},
            {"area_mm2", boundary.area},
            {"volume_mm3", boundary.volume ? Json(*boundary.volume) : Json()}};
  if (!boundary.is_closed()) json["open_at_mm"] = point_json(boundary.open_at);
  if (boundary.largest_gap > 0.0) json["largest_gap_at_mm"] = point_json(boundary.largest_gap_at);
  return json;
}

/// Scanned points, and what they are good for.
Json scans_json(const engine::Model& model) {
  Json json = Json::array();
  for (const engine::PointCloud& cloud : model.clouds) {
    json.push_back({{"points", cloud.points.size()},
                    {"spacing_mm", cloud.spacing},
                    {"noise_mm", cloud.noise},
                    {"served_tolerance_mm", engine::served_epsilon(cloud)}});
  }
  return json;
}

Json counts(const std::vector<engine::EntityCount>& entities) {
  Json json = Json::array();
  for (const engine::EntityCount& entity : entities) {
    json.push_back({{"type", entity.type}, {"name", entity.name}, {"count", entity.count}});
  }
  return json;
}

Json info_json(const engine::ImportResult& import, const engine::Box3& bounds,
               const engine::BoundaryReport& boundary, std::size_t patches) {
  const engine::ImportReport& report = import.report;
  Json json{
      {"name", import.model.name},
      {"format", report.format},
      {"unit", {{"flag", report.unit.flag}, {"name", report.unit.name}, {"mm", report.unit.millimetres}}},
      {"model_scale", report.model_scale},
      {"resolution_mm", report.resolution},
      {"bounds_mm", to_json(bounds)},
      {"surfaces", import.model.surfaces.size()},
      {"trimmed_surfaces", trimmed_count(import.model)},
      {"patches", patches},
      {"facets", facet_count(import.model)},
      {"scans", scans_json(import.model)},
      {"boundary", boundary_json(boundary)},
      {"surfaces_by_type", counts(report.surfaces)},
      {"entities", counts(report.entities)},
      {"skipped", Json::array()},
      {"tolerated", Json::array()},
      {"product", report.product},
      {"system", report.system},
      {"preprocessor", report.preprocessor},
      {"author", report.author},
      {"organization", report.organization}};
  for (const engine::SkippedEntities& skipped : report.skipped) {
    json["skipped"].push_back({{"type", skipped.type},
                               {"name", skipped.name},
                               {"count", skipped.count},
                               {"first_directory_line", skipped.first_directory_line},
                               {"reason", skipped.reason}});
  }
  for (const engine::ToleratedBreach& breach : report.tolerated) {
    json["tolerated"].push_back(
        {{"what", breach.what}, {"section", breach.section}, {"line", breach.line}, {"count", breach.count}});
  }
  return json;
}

void print_counts(const std::string& title, const std::vector<engine::EntityCount>& entities) {
  std::cout << title << '\n';
  for (const engine::EntityCount& entity : entities) {
    const std::string number = entity.type != 0 ? fmt::format("{} ", entity.type) : "";
    std::cout << fmt::format("  {:6} x {}{}\n", entity.count, number, entity.name);
  }
}

void print_boundary(const engine::BoundaryReport& boundary) {
  const auto place = [](const engine::Vector3& at) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", at.x(), at.y(), at.z());
  };
  if (boundary.is_closed()) {
    const std::string volume = boundary.volume ? fmt::format("volume {:.6g} mm^3", *boundary.volume)
                                               : "volume unclear (faces meet more than two to an edge)";
    std::cout << fmt::format("closed    yes, {}, area {:.6g} mm^2\n", volume, boundary.area);
  } else {
    std::cout << fmt::format("closed    no: {} of {} edges open, the first at {} mm; area {:.6g} mm^2\n",
                             boundary.open_edges, boundary.edges, place(boundary.open_at), boundary.area);
  }
  if (boundary.largest_gap > 0.0) {
    std::cout << fmt::format("gaps      up to {:.2g} mm, the largest at {} mm\n", boundary.largest_gap,
                             place(boundary.largest_gap_at));
  }
}

void print_text(const engine::ImportResult& import, const engine::Box3& bounds,
                const engine::BoundaryReport& boundary, std::size_t patches) {
  const engine::ImportReport& report = import.report;
  std::cout << fmt::format("{}: {}", import.model.name, report.format);
  if (!import.model.surfaces.empty()) {
    std::cout << fmt::format(", {} surfaces ({} trimmed), {} Bezier patches", import.model.surfaces.size(),
                             trimmed_count(import.model), patches);
  }
  if (!import.model.meshes.empty()) {
    std::cout << fmt::format(", {} triangles in {} meshes", facet_count(import.model),
                             import.model.meshes.size());
  }
  for (const engine::PointCloud& cloud : import.model.clouds)
    std::cout << fmt::format(", {} scanned points", cloud.points.size());
  std::cout << '\n';
  for (const engine::PointCloud& cloud : import.model.clouds) {
    std::cout << fmt::format(
        "scan      points {:.3g} mm apart, noise {:.2g} mm: serves a tolerance of {:.3g} mm\n", cloud.spacing,
        cloud.noise, engine::served_epsilon(cloud));
  }
  std::cout << fmt::format("unit      {} (flag {}), 1 unit = {} mm", report.unit.name, report.unit.flag,
                           report.unit.millimetres);
  if (report.model_scale != 1.0) std::cout << fmt::format(", model scale {}", report.model_scale);
  std::cout << '\n';
  if (!bounds.isEmpty()) {
    const engine::Vector3 size = bounds.sizes();
    const engine::Vector3& low = bounds.min();
    const engine::Vector3& high = bounds.max();
    std::cout << fmt::format("size      {:.4g} x {:.4g} x {:.4g} mm\n", size.x(), size.y(), size.z());
    std::cout << fmt::format("box       ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) mm\n", low.x(),
                             low.y(), low.z(), high.x(), high.y(), high.z());
  }
  if (report.resolution > 0.0)
    std::cout << fmt::format("tolerance {:.3g} mm, as the file says\n", report.resolution);
  const bool is_only_points = import.model.surfaces.empty() && import.model.meshes.empty();
  if (!is_only_points) print_boundary(boundary);
  if (!report.system.empty()) std::cout << "written by " << report.system << '\n';
  if (!report.surfaces.empty())
    print_counts("surfaces of the model, by the entity that they come from", report.surfaces);
  if (!report.entities.empty()) print_counts("entities of the file", report.entities);
}

ExitCode run(const InfoArguments& arguments) {
  const engine::ImportResult import = engine::read_model(arguments.model);
  const engine::Box3 bounds = engine::model_bounds(import.model);
  const engine::BoundaryReport boundary = engine::boundary_report(import.model);
  const std::size_t patches = patch_count(import.model);
  if (arguments.json) {
    std::cout << to_text(info_json(import, bounds, boundary, patches)) << '\n';
  } else {
    print_text(import, bounds, boundary, patches);
    for (const std::string& note : import_warnings(import.report)) std::cout << note << '\n';
  }
  return ExitCode::kOk;
}

}  // namespace

Verb info_verb() {
  const auto arguments = std::make_shared<InfoArguments>();
  return {"info", "Show what a model file holds: units, size, surfaces, gaps, what was skipped",
          "  lamina info part.igs\n"
          "  lamina info part.igs.gz --json",
          [arguments](OptionSet& options) {
            options.argument("MODEL", arguments->model, kModelFiles);
            options.flag("--json", arguments->json, "Print it as JSON");
          },
          [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
