#include <iostream>
#include <memory>

#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "engine/model_bounds.h"
#include "engine/nurbs/bezier.h"
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

Json counts(const std::vector<engine::EntityCount>& entities) {
  Json json = Json::array();
  for (const engine::EntityCount& entity : entities) {
    json.push_back({{"type", entity.type}, {"name", entity.name}, {"count", entity.count}});
  }
  return json;
}

Json info_json(const engine::ImportResult& import, const engine::Box3& bounds, std::size_t patches) {
  const engine::ImportReport& report = import.report;
  Json json{
      {"name", import.model.name},
      {"format", report.format},
      {"unit", {{"flag", report.unit.flag}, {"name", report.unit.name}, {"mm", report.unit.millimetres}}},
      {"model_scale", report.model_scale},
      {"resolution_mm", report.resolution},
      {"bounds_mm", to_json(bounds)},
      {"surfaces", import.model.surfaces.size()},
      {"patches", patches},
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
    std::cout << fmt::format("  {:6} x {} {}\n", entity.count, entity.type, entity.name);
  }
}

void print_text(const engine::ImportResult& import, const engine::Box3& bounds, std::size_t patches) {
  const engine::ImportReport& report = import.report;
  std::cout << fmt::format("{}: {}, {} surfaces, {} Bezier patches\n", import.model.name, report.format,
                           import.model.surfaces.size(), patches);
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
  if (!report.system.empty()) std::cout << "written by " << report.system << '\n';
  print_counts("surfaces of the model, by the entity that they come from", report.surfaces);
  print_counts("entities of the file", report.entities);
}

ExitCode run(const InfoArguments& arguments) {
  const engine::ImportResult import = engine::read_model(arguments.model);
  const engine::Box3 bounds = engine::model_bounds(import.model);
  const std::size_t patches = patch_count(import.model);
  if (arguments.json) {
    std::cout << to_text(info_json(import, bounds, patches)) << '\n';
  } else {
    print_text(import, bounds, patches);
    for (const std::string& note : import_warnings(import.report)) std::cout << note << '\n';
  }
  return ExitCode::kOk;
}

}  // namespace

Verb info_verb() {
  const auto arguments = std::make_shared<InfoArguments>();
  return {"info", "Show what a model file holds: units, size, surfaces, what was skipped",
          "  lamina info part.igs\n"
          "  lamina info part.igs.gz --json",
          [arguments](OptionSet& options) {
            options.argument("MODEL", arguments->model, "IGES file (.igs, .iges, also with .gz)");
            options.flag("--json", arguments->json, "Print it as JSON");
          },
          [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
