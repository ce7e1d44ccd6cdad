#include "tools/bench/opencascade_iges.h"

#ifdef LAMINA_BENCH_OPENCASCADE

#include <algorithm>
#include <chrono>
#include <random>

#include <BRep_Tool.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

namespace lamina::tools {

std::optional<OpencascadeReading> read_with_opencascade(const std::filesystem::path& path,
                                                        const engine::Model& model, int runs) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  OpencascadeReading reading;
  reading.seconds = 1e9;
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
  std::mt19937 random(20261122);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::size_t index = 0;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next(), ++index) {
    if (index >= model.surfaces.size()) break;
    const auto surface =
        Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(TopoDS::Face(faces.Current())));
    const engine::NurbsSurface& ours = model.surfaces[index].nurbs;
    if (surface.IsNull() || !model.surfaces[index].trim.empty()) continue;
    double first_u = 0.0;
    double last_u = 0.0;
    double first_v = 0.0;
    double last_v = 0.0;
    surface->Bounds(first_u, last_u, first_v, last_v);
    if (first_u != ours.first_u() || last_u != ours.last_u() || first_v != ours.first_v() ||
        last_v != ours.last_v())
      continue;
    ++reading.compared;
    for (int i = 0; i < 20; ++i) {
      const double u = first_u + part(random) * (last_u - first_u);
      const double v = first_v + part(random) * (last_v - first_v);
      const gp_Pnt point = surface->Value(u, v);
      const double distance =
          (engine::evaluate(ours, u, v) - engine::Vector3(point.X(), point.Y(), point.Z())).norm();
      reading.largest_distance = std::max(reading.largest_distance, distance);
    }
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
