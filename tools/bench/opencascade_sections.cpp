#include "tools/bench/opencascade_sections.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tools/bench/triangle_lines.h"

#ifdef LAMINA_BENCH_OPENCASCADE

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Section.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GCPnts_TangentialDeflection.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Poly_Triangulation.hxx>
#include <RWStl.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pln.hxx>

namespace lamina::tools {
namespace {

constexpr double kChordAngle = 0.01;  // rad between neighbouring chords
constexpr double kMeshAngle = 0.05;   // rad

template <typename Reader>
TopoDS_Shape shape_of(Reader& reader, const std::filesystem::path& file) {
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone)
    throw std::runtime_error(file.string() + ": OpenCASCADE cannot read it");
  reader.TransferRoots();
  return reader.OneShape();
}

FaceTriangles triangles_of(const Handle(Poly_Triangulation) & mesh, const gp_Trsf& place) {
  FaceTriangles face;
  face.corners.reserve(static_cast<std::size_t>(mesh->NbNodes()));
  for (int k = 1; k <= mesh->NbNodes(); ++k) {
    const gp_Pnt corner = mesh->Node(k).Transformed(place);
    face.corners.emplace_back(corner.X(), corner.Y(), corner.Z());
  }
  for (int k = 1; k <= mesh->NbTriangles(); ++k) {
    int a = 0;
    int b = 0;
    int c = 0;
    mesh->Triangle(k).Get(a, b, c);
    face.triangles.push_back({static_cast<std::uint32_t>(a - 1), static_cast<std::uint32_t>(b - 1),
                              static_cast<std::uint32_t>(c - 1)});
  }
  return face;
}

}  // namespace

struct OpencascadeModel::Shape {
  struct Face {
    TopoDS_Face face;
    std::size_t solid = 0;
    Bnd_Box box;
  };
  TopoDS_Shape shape;
  std::vector<Face> faces;
  Bnd_Box box;
  std::vector<std::pair<std::size_t, FaceTriangles>> triangles;  // with the number of their solid

  void add_faces(TopExp_Explorer explorer, std::size_t solid) {
    for (; explorer.More(); explorer.Next()) {
      Face& face = faces.emplace_back(Face{TopoDS::Face(explorer.Current()), solid, {}});
      BRepBndLib::Add(face.face, face.box, false);
      box.Add(face.box);
    }
  }
};

bool has_opencascade() {
  return true;
}

OpencascadeModel::OpencascadeModel(const std::filesystem::path& file) : shape_(std::make_unique<Shape>()) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const std::string extension = file.extension().string();
  if (extension == ".igs" || extension == ".iges") {
    IGESControl_Reader reader;
    shape_->shape = shape_of(reader, file);
  } else if (extension == ".stp" || extension == ".step") {
    STEPControl_Reader reader;
    shape_->shape = shape_of(reader, file);
  } else if (extension == ".brep") {
    BRepTools::Read(shape_->shape, file.c_str(), BRep_Builder());
  } else if (extension == ".stl") {
    const Handle(Poly_Triangulation) mesh = RWStl::ReadFile(file.c_str());
    if (!mesh.IsNull()) shape_->triangles.emplace_back(0, triangles_of(mesh, gp_Trsf()));
  }
  if (shape_->shape.IsNull() && shape_->triangles.empty())
    throw std::runtime_error(file.string() + ": OpenCASCADE cannot read it");
  if (shape_->shape.IsNull()) return;
  std::size_t solid = 0;
  for (TopExp_Explorer solids(shape_->shape, TopAbs_SOLID); solids.More(); solids.Next())
    shape_->add_faces(TopExp_Explorer(solids.Current(), TopAbs_FACE), ++solid);
  shape_->add_faces(TopExp_Explorer(shape_->shape, TopAbs_FACE, TopAbs_SOLID), 0);
}

OpencascadeModel::~OpencascadeModel() = default;

bool OpencascadeModel::has_faces() const {
  return !shape_->faces.empty();
}

LinesBySolid OpencascadeModel::section_lines(double z, double tolerance) const {
  double low_x = 0.0;
  double low_y = 0.0;
  double low_z = 0.0;
  double high_x = 0.0;
  double high_y = 0.0;
  double high_z = 0.0;
  shape_->box.Get(low_x, low_y, low_z, high_x, high_y, high_z);
  const double margin = 0.1 * (high_x - low_x + high_y - low_y);
  const gp_Pln plane(gp_Pnt(0.0, 0.0, z), gp_Dir(0.0, 0.0, 1.0));
  const TopoDS_Face cut =
      BRepBuilderAPI_MakeFace(plane, low_x - margin, high_x + margin, low_y - margin, high_y + margin).Face();
  LinesBySolid lines;
  for (const Shape::Face& face : shape_->faces) {
    face.box.Get(low_x, low_y, low_z, high_x, high_y, high_z);
    if (low_z > z || high_z < z) continue;
    try {
      BRepAlgoAPI_Section section(face.face, cut, false);
      section.Approximation(true);
      section.Build();
      if (!section.IsDone()) continue;
      for (TopExp_Explorer edges(section.Shape(), TopAbs_EDGE); edges.More(); edges.Next()) {
        const BRepAdaptor_Curve curve(TopoDS::Edge(edges.Current()));
        const GCPnts_TangentialDeflection chords(curve, kChordAngle, tolerance);
        engine::Polyline line;
        for (int k = 1; k <= chords.NbPoints(); ++k)
          line.emplace_back(chords.Value(k).X(), chords.Value(k).Y());
        if (line.size() >= 2) lines[face.solid].push_back(std::move(line));
      }
    } catch (const Standard_Failure&) {
      // The lines that are missing leave others open, which is counted.
    }
  }
  return lines;
}

void OpencascadeModel::make_triangles(double tolerance) {
  if (!has_faces()) return;
  const BRepMesh_IncrementalMesh mesher(shape_->shape, tolerance, false, kMeshAngle);
  for (const Shape::Face& face : shape_->faces) {
    TopLoc_Location place;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face.face, place);
    if (!mesh.IsNull())
      shape_->triangles.emplace_back(face.solid, triangles_of(mesh, place.Transformation()));
  }
}

LinesBySolid OpencascadeModel::triangle_lines(double z) const {
  LinesBySolid lines;
  for (const auto& [solid, triangles] : shape_->triangles) {
    const std::vector<engine::Polyline> more = tools::triangle_lines(triangles, z);
    if (!more.empty()) lines[solid].insert(lines[solid].end(), more.begin(), more.end());
  }
  return lines;
}

}  // namespace lamina::tools

#else

namespace lamina::tools {

struct OpencascadeModel::Shape {};

bool has_opencascade() {
  return false;
}

OpencascadeModel::OpencascadeModel(const std::filesystem::path&) {
  throw std::runtime_error("built without OpenCASCADE");
}

OpencascadeModel::~OpencascadeModel() = default;

bool OpencascadeModel::has_faces() const {
  return false;
}

LinesBySolid OpencascadeModel::section_lines(double, double) const {
  return {};
}

void OpencascadeModel::make_triangles(double) {}

LinesBySolid OpencascadeModel::triangle_lines(double) const {
  return {};
}

}  // namespace lamina::tools

#endif
