#include "tools/bench/opencascade_iges.h"

#ifdef LAMINA_BENCH_OPENCASCADE

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <vector>

#include <BRep_Tool.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

namespace lamina::tools {
namespace {

constexpr int kPoints = 20;
constexpr double kSame = 1e-6;

/// A surface's point, and the parameters that it has there.
struct SurfacePoint {
  double u;
  double v;
  gp_Pnt position;
};

std::vector<SurfacePoint> random_points(const engine::NurbsSurface& surface, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < kPoints; ++i) {
    const double u = surface.first_u() + part(random) * (surface.last_u() - surface.first_u());
    const double v = surface.first_v() + part(random) * (surface.last_v() - surface.first_v());
    const engine::Vector3 at = engine::evaluate(surface, u, v);
    points.push_back({u, v, {at.x(), at.y(), at.z()}});
  }
  return points;
}

/// Largest distance of the points from a surface: at the same parameters where it is there, else the
/// shortest.
double distance(const std::vector<SurfacePoint>& points, const Handle(Geom_Surface) & surface) {
  const bool is_spline = !Handle(Geom_BSplineSurface)::DownCast(surface).IsNull();
  ShapeAnalysis_Surface analysis(surface);
  double largest = 0.0;
  for (const SurfacePoint& point : points) {
    double first_u = 0.0;
    double last_u = 0.0;
    double first_v = 0.0;
    double last_v = 0.0;
    surface->Bounds(first_u, last_u, first_v, last_v);
    const bool is_inside = first_u <= point.u && point.u <= last_u && first_v <= point.v && point.v <= last_v;
    double off = std::numeric_limits<double>::infinity();
    if (is_spline && is_inside) off = surface->Value(point.u, point.v).Distance(point.position);
    if (off > kSame) {
      analysis.ValueOfUV(point.position, 1e-9);
      off = std::min(off, analysis.Gap());
    }
    largest = std::max(largest, off);
  }
  return largest;
}

}  // namespace

std::optional<OpencascadeReading> read_with_opencascade(const std::filesystem::path& path,
                                                        const engine::Model& model, int runs) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  OpencascadeReading reading;
  reading.seconds = std::numeric_limits<double>::infinity();
  TopoDS_Shape shape;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    IGESControl_Reader reader;
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return std::nullopt;
    reader.TransferRoots();
    shape = reader.OneShape();
    reading.seconds = std::min(
        reading.seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::vector<Handle(Geom_Surface)> theirs;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
    theirs.push_back(BRep_Tool::Surface(TopoDS::Face(faces.Current())));
  reading.faces = theirs.size();
  std::mt19937 random(20261122);
  for (std::size_t i = 0; i < model.surfaces.size(); ++i) {
    const std::vector<SurfacePoint> points = random_points(model.surfaces[i].nurbs, random);
    double nearest =
        i < theirs.size() ? distance(points, theirs[i]) : std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < theirs.size() && nearest > kSame; ++k)
      nearest = std::min(nearest, distance(points, theirs[k]));
    if (nearest <= reading.largest_distance) continue;
    reading.largest_distance = nearest;
    reading.farthest = i;
  }
  return reading;
}

}  // namespace lamina::tools

#else

namespace lamina::tools {

std::optional<OpencascadeReading> read_with_opencascade(const std::filesystem::path&, const engine::Model&,
                                                        int) {
  return std::nullopt;
}

}  // namespace lamina::tools

#endif
