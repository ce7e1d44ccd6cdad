#include "tools/cli/placement.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "engine/model_bounds.h"
#include "profiles/value.h"
#include "tools/cli/arrangement.h"
#include "tools/cli/failure.h"

namespace lamina::tools {
namespace {

using engine::Box3;
using engine::Model;
using engine::Vector2;
using engine::Vector3;

/// A part below this is hardly meant.
constexpr double kSuspiciouslySmall = 1.0;  // mm

void check(const PlacementArguments& arguments, std::size_t models) {
  const auto refuse = [](const std::string& problem) { throw Failure(ExitCode::kUsage, problem); };
  if (!(arguments.scale > 0.0)) {
    refuse("--scale is " + profiles::number_text(arguments.scale) + ": it must be a number above 0");
  }
  const auto has = [](const std::vector<double>& numbers, std::size_t count) {
    return numbers.empty() || numbers.size() == count;
  };
  if (!has(arguments.move, 2)) refuse("--move needs two numbers, as in --move 10,-5");
  if (!has(arguments.center, 2)) refuse("--center needs two numbers, as in --center 110,110");
  if (!has(arguments.rotate, 1) && !has(arguments.rotate, 3))
    refuse("--rotate needs an angle about z, or three about x, y and z, as in --rotate 0,90,0");
  if (!has(arguments.scale_to_fit, 3) ||
      std::any_of(arguments.scale_to_fit.begin(), arguments.scale_to_fit.end(),
                  [](double s) { return !(s > 0.0); }))
    refuse("--scale-to-fit needs three sizes above 0, as in --scale-to-fit 100,100,50");
  if (!arguments.scale_to_fit.empty() && arguments.scale != 1.0)
    refuse("--scale and --scale-to-fit both scale the model: give one of them");
  if (arguments.copies < 1) refuse("--copies is 0: there would be nothing to slice");
  if (!(arguments.spacing >= 0.0)) {
    refuse("--spacing is " + profiles::number_text(arguments.spacing) + ": it must be 0 or more");
  }
  const bool several = models > 1 || arguments.copies > 1;
  if (several && (arguments.keep_position || !arguments.center.empty()))
    refuse("several parts are arranged on the bed: --no-center and --center are for one");
}

Eigen::Affine3d turned(const std::vector<double>& degrees) {
  const auto about = [](double angle, const Vector3& axis) {
    return Eigen::AngleAxisd(angle * std::numbers::pi / 180.0, axis);
  };
  if (degrees.empty()) return Eigen::Affine3d::Identity();
  if (degrees.size() == 1) return Eigen::Affine3d(about(degrees[0], Vector3::UnitZ()));
  return Eigen::Affine3d(about(degrees[2], Vector3::UnitZ()) * about(degrees[1], Vector3::UnitY()) *
                         about(degrees[0], Vector3::UnitX()));
}

struct Posed {
  Model model;
  Box3 bounds;
};

/// The model turned and scaled, where it stands.
Posed pose(const Model& model, const PlacementArguments& arguments) {
  const Eigen::Affine3d turn = turned(arguments.rotate);
  const Box3 bounds =
      engine::model_bounds(arguments.rotate.empty() ? model : engine::transformed(model, turn));
  if (bounds.isEmpty() || !(bounds.sizes().z() > 0.0)) {
    throw Failure(ExitCode::kGeometry, model.name + " has no height: there is nothing to slice");
  }
  double scale = arguments.scale;
  if (!arguments.scale_to_fit.empty()) {
    const Vector3 target(arguments.scale_to_fit[0], arguments.scale_to_fit[1], arguments.scale_to_fit[2]);
    scale = target.cwiseQuotient(bounds.sizes().cwiseMax(1e-12)).minCoeff();
  }
  const Eigen::UniformScaling<double> scaling = Eigen::Scaling(scale);
  return {engine::transformed(model, scaling * turn), Box3(scale * bounds.min(), scale * bounds.max())};
}

/// Solids of one model stay apart from those of the others.
void append(Model& all, Model part) {
  std::uint32_t highest = 0;
  for (const engine::Surface& surface : all.surfaces) highest = std::max(highest, surface.solid);
  for (const engine::TriangleMesh& mesh : all.meshes) highest = std::max(highest, mesh.solid);
  const auto move_all = [](auto& from, auto& to) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  for (engine::Surface& surface : part.surfaces) surface.solid += surface.solid != 0 ? highest : 0;
  for (engine::TriangleMesh& mesh : part.meshes) mesh.solid += mesh.solid != 0 ? highest : 0;
  move_all(part.surfaces, all.surfaces);
  move_all(part.meshes, all.meshes);
  std::move(part.clouds.begin(), part.clouds.end(), std::back_inserter(all.clouds));
}

void add(PlacedModel& placed, const Posed& posed, const Vector3& shift) {
  append(placed.model, engine::transformed(posed.model, Eigen::Affine3d(Eigen::Translation3d(shift))));
  placed.bounds.extend(Box3(posed.bounds.min() + shift, posed.bounds.max() + shift));
}

}  // namespace

void PlacementArguments::declare(OptionSet& options) {
  options.number("--scale", scale, "FACTOR", "Scale the model, such as 0.5 or 25.4");
  options.numbers("--scale-to-fit", scale_to_fit, "X,Y,Z", "Scale it to the largest size within these, mm");
  options.numbers("--rotate", rotate, "Z|X,Y,Z", "Turn it about z, or about x, then y, then z, degrees");
  options.numbers("--center", center, "X,Y", "Where its middle goes [the bed's middle]");
  options.flag("--no-center", keep_position,
               "Keep the model's own x and y instead of centring it on the bed");
  options.numbers("--move", move, "X,Y", "Move it on the bed, mm");
  options.count("--copies", copies, "N", "That many of each model, side by side");
  options.number("--spacing", spacing, "MM", "Between parts on one bed [6]");
}

PlacedModel place(const std::vector<Model>& models, const PlacementArguments& arguments,
                  const gcode::PrintVolume& volume) {
  check(arguments, models.size());
  std::vector<Posed> posed;
  PlacedModel placed;
  for (const Model& model : models) {
    posed.push_back(pose(model, arguments));
    const double largest = posed.back().bounds.sizes().maxCoeff();
    if (largest < kSuspiciouslySmall) {
      placed.warnings.push_back(fmt::format(
          "{} is only {:.4g} mm large: is its unit right? --scale 25.4 makes inches of mm, --scale 1000 "
          "metres",
          model.name, largest));
    }
  }
  placed.model.name = models.front().name;
  const Vector2 moved =
      arguments.move.empty() ? Vector2::Zero() : Vector2(arguments.move[0], arguments.move[1]);
  const auto shift_to = [&](const Posed& part, const Vector2& place_of_middle) {
    const Vector2 by = place_of_middle - part.bounds.center().head<2>() + moved;
    return Vector3(by.x(), by.y(), -part.bounds.min().z());
  };
  if (models.size() == 1 && arguments.copies == 1) {
    const Posed& part = posed.front();
    const Vector2 own = part.bounds.center().head<2>();
    const Vector2 asked = arguments.center.empty() ? Vector2(volume.center().head<2>())
                                                   : Vector2(arguments.center[0], arguments.center[1]);
    add(placed, part, shift_to(part, arguments.keep_position ? own : asked));
  } else {
    std::vector<Vector2> sizes;
    for (const Posed& part : posed)
      sizes.insert(sizes.end(), static_cast<std::size_t>(arguments.copies), part.bounds.sizes().head<2>());
    // Of a round bed the square inside.
    const double part_of_box = volume.shape == gcode::BedShape::kCircle ? std::numbers::sqrt2 / 2.0 : 1.0;
    const Vector2 bed = part_of_box * volume.bounds().sizes().head<2>();
    const std::vector<Vector2> corners = arrange(sizes, arguments.spacing, bed);
    const Vector2 origin = volume.center().head<2>() - 0.5 * bed;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Posed& part = posed[k / static_cast<std::size_t>(arguments.copies)];
      add(placed, part, shift_to(part, origin + corners[k] + 0.5 * sizes[k]));
    }
  }
  gcode::check_fit(placed.bounds, volume, "model");
  return placed;
}

}  // namespace lamina::tools
