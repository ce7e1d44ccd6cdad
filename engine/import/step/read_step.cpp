// The one file that sees OpenCASCADE.

#include "engine/import/step/read_step.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <streambuf>
#include <utility>
#include <vector>

#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <fmt/format.h>

#include "engine/import/breach_log.h"
#include "engine/import/import_error.h"
#include "engine/import/trim/axis_map.h"
#include "engine/import/trim/fitted_path.h"
#include "engine/import/trim/trimmed_patch.h"
#include "engine/nurbs/knot_insertion.h"
#include "engine/nurbs/reverse.h"

namespace lamina::engine {
namespace {

/// Bytes in memory as a stream, without a copy.
class MemoryBuffer : public std::streambuf {
 public:
  explicit MemoryBuffer(std::string_view bytes) {
    // Reading only; the interface of streams is older than const.
    char* first = const_cast<char*>(bytes.data());
    setg(first, first, first + bytes.size());
  }

 protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    char* base = from == std::ios_base::beg ? eback() : from == std::ios_base::cur ? gptr() : egptr();
    if (offset < eback() - base || offset > egptr() - base) return pos_type(off_type(-1));
    setg(eback(), base + offset, egptr());
    return pos_type(gptr() - eback());
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }
};

/// A knot vector with every knot as often as it counts.
template <typename Array, typename Counts>
Knots flat_knots(const Array& knots, const Counts& counts) {
  Knots flat;
  for (int i = knots.Lower(); i <= knots.Upper(); ++i)
    flat.insert(flat.end(), static_cast<std::size_t>(counts(i)), knots(i));
  return flat;
}

NurbsSurface nurbs_of(const Handle(Geom_BSplineSurface) & given) {
  const Handle(Geom_BSplineSurface) surface = Handle(Geom_BSplineSurface)::DownCast(given->Copy());
  if (surface->IsUPeriodic()) surface->SetUNotPeriodic();
  if (surface->IsVPeriodic()) surface->SetVNotPeriodic();
  NurbsSurface result;
  result.degree_u = surface->UDegree();
  result.degree_v = surface->VDegree();
  result.knots_u = flat_knots(surface->UKnots(), surface->UMultiplicities());
  result.knots_v = flat_knots(surface->VKnots(), surface->VMultiplicities());
  result.net.count_u = static_cast<std::size_t>(surface->NbUPoles());
  result.net.count_v = static_cast<std::size_t>(surface->NbVPoles());
  result.net.points.reserve(result.net.count_u * result.net.count_v);
  // OpenCASCADE 7.6 gives weights of 0 for polynomial surfaces that were periodic.
  const bool is_rational = surface->IsURational() || surface->IsVRational();
  for (int i = 1; i <= surface->NbUPoles(); ++i) {
    for (int j = 1; j <= surface->NbVPoles(); ++j) {
      const gp_Pnt point = surface->Pole(i, j);
      result.net.points.push_back(
          homogeneous({point.X(), point.Y(), point.Z()}, is_rational ? surface->Weight(i, j) : 1.0));
    }
  }
  return clamped(result);
}

NurbsCurve nurbs_of(const Handle(Geom2d_Curve) & curve, double first, double last) {
  const Handle(Geom2d_TrimmedCurve) piece = new Geom2d_TrimmedCurve(curve, first, last);
  const Handle(Geom2d_BSplineCurve) spline = Geom2dConvert::CurveToBSplineCurve(piece);
  if (spline->IsPeriodic()) spline->SetNotPeriodic();
  NurbsCurve result;
  result.degree = spline->Degree();
  result.knots = flat_knots(spline->Knots(), spline->Multiplicities());
  const bool is_rational = spline->IsRational();
  for (int i = 1; i <= spline->NbPoles(); ++i) {
    const gp_Pnt2d point = spline->Pole(i);
    result.control_points.push_back(
        homogeneous({point.X(), point.Y(), 0.0}, is_rational ? spline->Weight(i) : 1.0));
  }
  return clamped(result);
}

/// A face's surface, and how its parameters become those of the NURBS surface.
struct FaceGround {
  NurbsSurface nurbs;
  ParameterMap map;
};

FaceGround ground_of(const TopoDS_Face& face) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  const GeomAbs_SurfaceType kind = GeomAdaptor_Surface(surface).GetType();
  if (kind == GeomAbs_BSplineSurface || kind == GeomAbs_BezierSurface) {
    Handle(Geom_Surface) basis = surface;
    while (const Handle(Geom_RectangularTrimmedSurface) trimmed =
               Handle(Geom_RectangularTrimmedSurface)::DownCast(basis))
      basis = trimmed->BasisSurface();
    return {nurbs_of(GeomConvert::SurfaceToBSplineSurface(basis)), {}};
  }
  double first_u = 0.0;
  double last_u = 0.0;
  double first_v = 0.0;
  double last_v = 0.0;
  BRepTools::UVBounds(face, first_u, last_u, first_v, last_v);
  // Room for curves that reach beyond by rounding, but no more than a turn.
  Handle(Geom_Surface) basis = surface;
  if (const Handle(Geom_RectangularTrimmedSurface) trimmed =
          Handle(Geom_RectangularTrimmedSurface)::DownCast(basis))
    basis = trimmed->BasisSurface();
  const auto bounded = [](double& first, double& last, bool is_periodic, double period, double lowest,
                          double highest) {
    const double room = 1e-9 * (last - first);
    first -= room;
    last += room;
    if (is_periodic) {
      last = std::min(last, first + period);
      return;
    }
    first = std::max(first, lowest);
    last = std::min(last, highest);
  };
  double lowest_u = 0.0;
  double highest_u = 0.0;
  double lowest_v = 0.0;
  double highest_v = 0.0;
  basis->Bounds(lowest_u, highest_u, lowest_v, highest_v);
  bounded(first_u, last_u, basis->IsUPeriodic(), basis->IsUPeriodic() ? basis->UPeriod() : 0.0, lowest_u,
          highest_u);
  bounded(first_v, last_v, basis->IsVPeriodic(), basis->IsVPeriodic() ? basis->VPeriod() : 0.0, lowest_v,
          highest_v);
  const Handle(Geom_RectangularTrimmedSurface) piece =
      new Geom_RectangularTrimmedSurface(basis, first_u, last_u, first_v, last_v);
  FaceGround ground{nurbs_of(GeomConvert::SurfaceToBSplineSurface(piece)), {}};
  ground.map = {angle_map_u(ground.nurbs), angle_map_v(ground.nurbs)};
  return ground;
}

/// Curves of a wire in the parameter plane of its face, in the order in which they follow each other.
std::vector<NurbsCurve> curves_of(const TopoDS_Wire& wire, const TopoDS_Face& face) {
  std::vector<TopoDS_Edge> edges;
  for (BRepTools_WireExplorer explorer(wire, face); explorer.More(); explorer.Next())
    edges.push_back(explorer.Current());
  std::vector<TopoDS_Edge> all;
  for (TopExp_Explorer explorer(wire, TopAbs_EDGE); explorer.More(); explorer.Next())
    all.push_back(TopoDS::Edge(explorer.Current()));
  if (edges.size() < all.size()) edges = all;  // the explorer stops where edges do not meet
  std::vector<NurbsCurve> curves;
  for (const TopoDS_Edge& edge : edges) {
    double first = 0.0;
    double last = 0.0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (curve.IsNull() || !(first < last)) continue;
    NurbsCurve made = nurbs_of(curve, first, last);
    curves.push_back(edge.Orientation() == TopAbs_REVERSED ? reversed(made) : made);
  }
  return curves;
}

/// Largest distance between the NURBS surface and the face's own at the same parameters, along a curve.
double mismatch(const FaceGround& ground, const Handle(Geom_Surface) & surface, const NurbsCurve& curve) {
  double largest = 0.0;
  for (const double part : {0.13, 0.5, 0.81}) {
    const Vector2 at =
        evaluate(curve, curve.first_parameter() + part * (curve.last_parameter() - curve.first_parameter()))
            .head<2>();
    const Vector2 mapped = ground.map(at);
    const double u = std::clamp(mapped.x(), ground.nurbs.first_u(), ground.nurbs.last_u());
    const double v = std::clamp(mapped.y(), ground.nurbs.first_v(), ground.nurbs.last_v());
    const gp_Pnt point = surface->Value(at.x(), at.y());
    largest =
        std::max(largest, (evaluate(ground.nurbs, u, v) - Vector3(point.X(), point.Y(), point.Z())).norm());
  }
  return largest;
}

/// Turns faces into surfaces of a model.
class FaceReader {
 public:
  explicit FaceReader(BreachLog& log) : log_(log) {}

  /// `solid`: number of the solid that the face is of, 0 where there is none.
  void read(TopoDS_Face face, std::size_t number, std::uint32_t solid, Model& model) {
    face.Orientation(TopAbs_FORWARD);
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    if (surface.IsNull()) {
      log_.note("face without a surface, left out", "face", number);
      return;
    }
    FaceGround ground = ground_of(face);
    constexpr double kPart = 1e-6;
    const double tolerance = kPart * control_box(ground.nurbs.net).diagonal().norm();
    const SurfaceTopology topology = surface_topology(ground.nurbs, tolerance);
    const SurfaceInverse inverse(ground.nurbs, topology);
    const LoopGround loop_ground{ground.nurbs, topology, inverse, tolerance};
    std::vector<ParameterLoop> loops;
    for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
      std::vector<NurbsCurve> curves = curves_of(TopoDS::Wire(wires.Current()), face);
      for (NurbsCurve& curve : curves) curve = mapped(curve, ground, surface, inverse, tolerance);
      ParameterLoop loop = chained_loop(curves, loop_ground);
      if (loop.largest_gap > 10.0 * std::max(tolerance, BRep_Tool::Tolerance(face)))
        log_.note("gap in a trim loop, bridged", "face", number, fmt::format("{:.3g} mm", loop.largest_gap));
      loops.push_back(std::move(loop));
    }
    auto patch = trimmed_patch(ground.nurbs, topology, std::move(loops), false, tolerance);
    if (!patch) {
      log_.note("face whose trim loops bound no area, left out", "face", number);
      return;
    }
    const auto finite = [](const Vector4& point) { return point.allFinite() && point.w() > 0.0; };
    const auto& points = patch->nurbs.net.points;
    if (!std::all_of(points.begin(), points.end(), finite)) {
      log_.note("face with a coordinate that is no number, left out", "face", number);
      return;
    }
    model.surfaces.push_back(
        {std::move(patch->nurbs), std::move(patch->trim), 0, static_cast<int>(number), solid});
    ++kinds_[GeomAdaptor_Surface(surface).GetType()];
  }

  std::vector<EntityCount> kinds() const {
    static constexpr const char* kNames[] = {"plane",
                                             "cylinder",
                                             "cone",
                                             "sphere",
                                             "torus",
                                             "Bezier surface",
                                             "B-spline surface",
                                             "surface of revolution",
                                             "surface of extrusion",
                                             "offset surface",
                                             "other surface"};
    std::vector<EntityCount> list;
    for (const auto& [kind, count] : kinds_)
      list.push_back({0, kNames[std::min<std::size_t>(kind, 10)], count});
    return list;
  }

 private:
  NurbsCurve mapped(const NurbsCurve& curve, const FaceGround& ground, const Handle(Geom_Surface) & surface,
                    const SurfaceInverse& inverse, double tolerance) {
    const auto length = [&](const Vector2& at, const Vector2& by) { return inverse.step_length(at, by); };
    const std::vector<double> breaks = break_points(curve.knots, curve.degree);
    if (mismatch(ground, surface, curve) > tolerance) {
      // Neither the same parameters nor angles: by the points themselves.
      return fitted_path(
          [&](double t) {
            const Vector2 at = evaluate(curve, t).head<2>();
            const gp_Pnt point = surface->Value(at.x(), at.y());
            return inverse.nearest({point.X(), point.Y(), point.Z()}, ground.map(at)).at;
          },
          breaks, length, tolerance);
    }
    if (ground.map.is_identity()) return curve;
    return fitted_path([&](double t) { return ground.map(evaluate(curve, t).head<2>()); }, breaks, length,
                       0.1 * tolerance);
  }

  BreachLog& log_;
  std::map<std::size_t, std::size_t> kinds_;
};

ImportResult read_shape(const TopoDS_Shape& shape, const std::string& file) {
  ImportResult result;
  BreachLog log;
  FaceReader reader(log);
  std::size_t number = 0;
  const auto read_faces = [&](TopExp_Explorer faces, std::uint32_t solid) {
    for (; faces.More(); faces.Next()) {
      ++number;
      try {
        reader.read(TopoDS::Face(faces.Current()), number, solid, result.model);
      } catch (const Standard_Failure& failure) {
        log.note("face that OpenCASCADE cannot convert, left out", "face", number,
                 failure.GetMessageString());
      }
    }
  };
  std::uint32_t solid = 0;
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next())
    read_faces(TopExp_Explorer(solids.Current(), TopAbs_FACE), ++solid);
  read_faces(TopExp_Explorer(shape, TopAbs_FACE, TopAbs_SOLID), 0);
  if (result.model.surfaces.empty()) {
    throw ImportError({.file = file},
                      fmt::format("nothing to slice: {} faces, none of which can be used", number),
                      "export solids or surfaces");
  }
  result.model.name = file;
  result.report.unit = {0, "MM", 1.0};
  result.report.surfaces = reader.kinds();
  result.report.entities = {{0, "face", number}};
  result.report.tolerated = log.list();
  return result;
}

/// Runs `read`; what OpenCASCADE throws becomes an ImportError.
template <typename Read>
auto guarded(const std::string& file, const Read& read) {
  try {
    Message::DefaultMessenger()->ChangePrinters().Clear();  // libraries do not print
    return read();
  } catch (const Standard_Failure& failure) {
    throw ImportError({.file = file},
                      fmt::format("OpenCASCADE cannot read it: {}", failure.GetMessageString()),
                      "export the file again");
  }
}

}  // namespace

ImportResult read_step(std::string_view bytes, const std::string& file) {
  return guarded(file, [&] {
    MemoryBuffer buffer(bytes);
    std::istream stream(&buffer);
    STEPControl_Reader reader;
    if (reader.ReadStream(file.c_str(), stream) != IFSelect_RetDone)
      throw ImportError({.file = file}, "is no STEP file that OpenCASCADE can read", "export the file again");
    reader.TransferRoots();
    const TopoDS_Shape shape = reader.OneShape();
    if (shape.IsNull()) throw ImportError({.file = file}, "nothing to slice: the file holds no shape");
    ImportResult result = read_shape(shape, file);
    result.report.format = "STEP";
    TColStd_SequenceOfAsciiString lengths;
    TColStd_SequenceOfAsciiString angles;
    TColStd_SequenceOfAsciiString solid_angles;
    reader.FileUnits(lengths, angles, solid_angles);
    // OpenCASCADE has turned all lengths into mm; the file's own unit is told all the same.
    static const std::map<std::string, double> kUnits{{"millimetre", 1.0},  {"metre", 1000.0},
                                                      {"centimetre", 10.0}, {"INCH", 25.4},
                                                      {"inch", 25.4},       {"FOOT", 304.8}};
    if (lengths.Length() > 0) {
      const std::string name = lengths.First().ToCString();
      const auto known = kUnits.find(name);
      result.report.unit = {0, name, known != kUnits.end() ? known->second : 1.0};
    }
    return result;
  });
}

ImportResult read_brep(std::string_view bytes, const std::string& file) {
  return guarded(file, [&] {
    MemoryBuffer buffer(bytes);
    std::istream stream(&buffer);
    TopoDS_Shape shape;
    BRepTools::Read(shape, stream, BRep_Builder());
    if (shape.IsNull()) throw ImportError({.file = file}, "is no shape that OpenCASCADE can read");
    ImportResult result = read_shape(shape, file);
    result.report.format = "BREP";
    return result;
  });
}

}  // namespace lamina::engine
