#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/geometry/bspline_basis.h"
#include "engine/import/import_error.h"
#include "engine/import/read_model.h"
#include "engine/nurbs/curve.h"
#include "tests/support/corpus.h"
#include "tests/support/manifest.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

/// What is asked of one model.
struct Expected {
  std::string file;
  Vector3 low = Vector3::Zero();
  Vector3 high = Vector3::Zero();
  std::string entities;
  bool is_watertight = false;
  double volume = 0.0;  ///< 0 where the table has none
  double area = 0.0;
};

/// Rows of IGES files whose surfaces are all untrimmed.
std::vector<Expected> readable_rows() {
  const std::string readable[] = {"100", "102", "104", "110", "112", "114", "116",
                                  "118", "120", "122", "124", "126", "128"};
  std::vector<Expected> rows;
  for (const ManifestRow& cells : manifest_rows({".ig"})) {
    Expected row;
    row.file = cells[1];
    row.entities = cells[5];
    bool is_readable = true;
    std::istringstream entities(row.entities);
    for (std::string entity; entities >> entity;) {
      const std::string type = entity.substr(0, entity.find(':'));
      is_readable =
          is_readable && std::find(std::begin(readable), std::end(readable), type) != std::end(readable);
    }
    if (!is_readable) continue;
    std::string dots;
    std::istringstream(cells[4]) >> row.low.x() >> row.low.y() >> row.low.z() >> dots >> row.high.x() >>
        row.high.y() >> row.high.z();
    row.is_watertight = cells[7].substr(0, 3) == "yes";
    if (cells[8] != "-") row.volume = std::stod(cells[8]);
    row.area = std::stod(cells[9]);
    rows.push_back(row);
  }
  return rows;
}

/// Gauss-Legendre rule on [0, 1].
struct Rule {
  std::vector<double> nodes;
  std::vector<double> weights;
};

Rule three_points() {
  const double x = std::sqrt(0.6) / 2.0;
  return {{0.5 - x, 0.5, 0.5 + x}, {5.0 / 18, 8.0 / 18, 5.0 / 18}};
}

/// What the integrals over a surface say: a third of x . n, n, and |n|, n the normal.
struct Integrals {
  double volume = 0.0;
  Vector3 vector_area = Vector3::Zero();
  double area = 0.0;
};

/// Gauss quadrature on every knot span cut into `cuts` x `cuts` pieces.
Integrals integrate(const NurbsSurface& surface, int cuts) {
  const Rule rule = three_points();
  const auto pieces = [cuts](const std::vector<double>& breaks) {
    std::vector<double> fine;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      for (int k = 0; k < cuts; ++k) fine.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / cuts);
    }
    fine.push_back(breaks.back());
    return fine;
  };
  const auto us = pieces(break_points(surface.knots_u, surface.degree_u));
  const auto vs = pieces(break_points(surface.knots_v, surface.degree_v));
  Integrals sum;
  for (std::size_t i = 0; i + 1 < us.size(); ++i) {
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
      const double du = us[i + 1] - us[i];
      const double dv = vs[j + 1] - vs[j];
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
          const SurfaceDerivatives d =
              evaluate_derivatives(surface, us[i] + du * rule.nodes[a], vs[j] + dv * rule.nodes[b]);
          const double weight = rule.weights[a] * rule.weights[b] * du * dv;
          const Vector3 normal = d.du.cross(d.dv);
          sum.volume += weight * d.point.dot(normal) / 3.0;
          sum.vector_area += weight * normal;
          sum.area += weight * normal.norm();
        }
      }
    }
  }
  return sum;
}

/// Largest value of `direction . S(u, v)`: the best of a grid, then grids around it, each finer.
double extent(const std::vector<const NurbsSurface*>& surfaces, const Vector3& direction) {
  double best = -1e300;
  const NurbsSurface* best_surface = nullptr;
  Vector2 best_at = Vector2::Zero();
  const auto search = [&](const NurbsSurface& surface, Vector2 low, Vector2 high, std::size_t steps_u,
                          std::size_t steps_v) {
    for (std::size_t i = 0; i <= steps_u; ++i) {
      for (std::size_t j = 0; j <= steps_v; ++j) {
        const Vector2 part(static_cast<double>(i) / static_cast<double>(steps_u),
                           static_cast<double>(j) / static_cast<double>(steps_v));
        const Vector2 at = low + (high - low).cwiseProduct(part);
        const double value = direction.dot(evaluate(surface, at.x(), at.y()));
        if (value > best) {
          best = value;
          best_surface = &surface;
          best_at = at;
        }
      }
    }
  };
  for (const NurbsSurface* surface : surfaces) {
    search(*surface, {surface->first_u(), surface->first_v()}, {surface->last_u(), surface->last_v()},
           2 * surface->net.count_u + 8, 2 * surface->net.count_v + 8);
  }
  Vector2 size(best_surface->last_u() - best_surface->first_u(),
               best_surface->last_v() - best_surface->first_v());
  for (int round = 0; round < 6; ++round) {
    size /= 6.0;
    const Vector2 domain_low(best_surface->first_u(), best_surface->first_v());
    const Vector2 domain_high(best_surface->last_u(), best_surface->last_v());
    const Vector2 low = (best_at - size / 2).cwiseMax(domain_low);
    const Vector2 high = (best_at + size / 2).cwiseMin(domain_high);
    search(*best_surface, low, high, 12, 12);
  }
  return best;
}

/// Surfaces whose control points reach as far as the best lower bound of any surface: the others cannot
/// matter.
std::vector<const NurbsSurface*> candidates(const Model& model, const Vector3& direction) {
  const auto value = [&](const Vector3& p) { return direction.dot(p); };
  double reached = -1e300;
  for (const Surface& surface : model.surfaces) {
    const NurbsSurface& s = surface.nurbs;
    for (const double u : {s.first_u(), s.last_u()}) {
      for (const double v : {s.first_v(), s.last_v()}) reached = std::max(reached, value(evaluate(s, u, v)));
    }
  }
  std::vector<const NurbsSurface*> list;
  for (const Surface& surface : model.surfaces) {
    for (const Vector4& point : surface.nurbs.net.points) {
      if (value(cartesian(point)) >= reached) {
        list.push_back(&surface.nurbs);
        break;
      }
    }
  }
  return list;
}

/// Number of surfaces that a file of these entities must give.
std::size_t expected_surfaces(const std::string& entities) {
  std::size_t count = 0;
  std::istringstream stream(entities);
  for (std::string entity; stream >> entity;) {
    const std::string type = entity.substr(0, entity.find(':'));
    if (type == "114" || type == "118" || type == "120" || type == "122" || type == "128") {
      count += std::stoul(entity.substr(entity.find(':') + 1));
    }
  }
  return count;
}

/// How the surfaces of a file are turned, and so what the divergence theorem can say.
enum class Turned {
  kAlike,  ///< all outwards or all inwards: the sum is the volume, up to its sign
  kMixed,  ///< some each way, few surfaces: some choice of signs closes the boundary and gives the volume
  kAlikeButFlat,  ///< but for a plane through the origin, which adds nothing to the volume: the sum is right
  kMixedAndMany,  ///< no statement
};

Turned turned(const std::string& file) {
  if (file == "analytic/box_mixed_normals.igs" || file.find("mix_") != std::string::npos)
    return Turned::kMixed;
  if (file == "seed/skullmask1260.igs") return Turned::kAlikeButFlat;
  if (file == "seed/initials_WEO.igs") return Turned::kMixedAndMany;
  return Turned::kAlike;
}

}  // namespace

TEST_CASE("corpus: surfaces, boxes, volumes and areas are those of the manifest") {
  if (!corpus_present()) {
    WARN("the model corpus is missing: skipped");
    return;
  }
  const std::vector<Expected> rows = readable_rows();
  REQUIRE(rows.size() >= 30);
  for (const Expected& row : rows) {
    INFO(row.file);
    const ImportResult result = read_model(corpus_file(row.file));
    const Model& model = result.model;
    CHECK(model.surfaces.size() == expected_surfaces(row.entities));
    CHECK(result.report.tolerated.empty());

    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Vector3 up = Vector3::Unit(axis);
      CHECK(extent(candidates(model, up), up) == Approx(row.high[axis]).margin(1e-4));
      CHECK(-extent(candidates(model, -up), -up) == Approx(row.low[axis]).margin(1e-4));
    }

    const int cuts = model.surfaces.size() > 100 ? 1 : 6;
    std::vector<Integrals> parts;
    for (const Surface& surface : model.surfaces) parts.push_back(integrate(surface.nurbs, cuts));
    Integrals sum;
    for (const Integrals& part : parts) {
      sum.volume += part.volume;
      sum.vector_area += part.vector_area;
      sum.area += part.area;
    }
    CHECK(sum.area == Approx(row.area).epsilon(1e-3));
    if (!row.is_watertight || row.volume == 0.0) continue;
    const Turned way = turned(row.file);
    // Closed and turned one way: the vector areas cancel, and the volume does not depend on the origin.
    if (way == Turned::kAlike) CHECK(sum.vector_area.norm() < 1e-3 * sum.area);
    if (way == Turned::kAlike || way == Turned::kAlikeButFlat) {
      CHECK(std::abs(sum.volume) == Approx(row.volume).epsilon(1e-4));
    }
    if (way != Turned::kMixed) continue;
    // Some choice of signs closes the surface; it must then give the volume.
    bool found = false;
    for (unsigned signs = 0; signs < (1U << parts.size()); ++signs) {
      Integrals chosen;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        const double sign = ((signs >> i) & 1U) != 0U ? -1.0 : 1.0;
        chosen.volume += sign * parts[i].volume;
        chosen.vector_area += sign * parts[i].vector_area;
      }
      const bool closes = chosen.vector_area.norm() < 1e-6 * sum.area;
      found = found || (closes && std::abs(std::abs(chosen.volume) - row.volume) < 1e-4 * row.volume);
    }
    CHECK(found);
  }
}

TEST_CASE("corpus: the report of a file tells what its header says") {
  if (!corpus_present()) {
    WARN("the model corpus is missing: skipped");
    return;
  }
  const ImportReport report = read_model(corpus_file("entities/mix_124_inch.igs")).report;
  CHECK(report.unit.flag == 1);
  CHECK(report.unit.name == "INCH");
  CHECK(report.unit.millimetres == 25.4);
  CHECK(report.resolution == Approx(25.4e-5));
  CHECK(report.author == "corpus generator");
  CHECK(report.line_count == 50);
  REQUIRE(report.entities.size() == 2);
  CHECK(report.entities[0].type == 124);
  CHECK(report.entities[0].count == 7);
  CHECK(report.entities[1].name == "rational B-spline surface");
}
