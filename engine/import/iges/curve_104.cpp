#include <algorithm>

#include <fmt/format.h>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/nurbs/conic.h"

namespace lamina::engine {
namespace {

/// Form number of a kind of conic; form 0 leaves it to the coefficients.
int form_of(ConicKind kind) {
  switch (kind) {
    case ConicKind::kEllipse:
      return 1;
    case ConicKind::kHyperbola:
      return 2;
    case ConicKind::kParabola:
      return 3;
    case ConicKind::kDegenerate:
      break;
  }
  return 0;
}

}  // namespace

/// IGES 5.3, section 4.5: an arc of the conic a x^2 + b x y + c y^2 + d x + e y + f = 0 in a plane of
/// constant z.
NurbsCurve read_conic_arc_104(ParameterRecord& record, EntityReader& reader) {
  Conic conic;
  for (double* coefficient : {&conic.a, &conic.b, &conic.c, &conic.d, &conic.e, &conic.f}) {
    *coefficient = record.real("coefficient");
  }
  const double z = record.real("plane");
  const Vector2 start = record.planar_vector("start point");
  Vector2 end = record.planar_vector("end point");

  const ConicKind kind = classify(conic);
  if (kind == ConicKind::kDegenerate)
    record.fail("the coefficients describe no ellipse, parabola or hyperbola");
  const int form = record.entry().form;
  if (form != 0 && form != form_of(kind)) record.note(Tolerance::kConicForm, fmt::format("form {}", form));

  const double size = std::max(start.norm(), end.norm());
  const double same_point = reader.same_point_distance(size);
  for (const Vector2& on_conic : {start, end}) {
    const double distance = distance_to(conic, on_conic);
    if (!(distance <= 0.01 * size)) {
      record.fail(fmt::format("the point ({:.9g}, {:.9g}) is {:.6g} off the conic", on_conic.x(),
                              on_conic.y(), distance));
    }
    if (distance > same_point) record.note(Tolerance::kConicEnds, fmt::format("{:.6g}", distance));
  }
  if ((end - start).norm() <= same_point) end = start;
  std::optional<NurbsCurve> curve = conic_arc(conic, start, end, z);
  if (!curve)
    record.fail("start and end point are the same or on different branches: there is no arc between them");
  return *std::move(curve);
}

}  // namespace lamina::engine
