// Sections of corpus models at which a contour once left the model, or the model the contours.

#include <string>

#include <catch2/catch.hpp>

#include "engine/geometry/piece_curve.h"
#include "engine/import/read_model.h"
#include "engine/slicer.h"
#include "tests/support/corpus.h"
#include "tools/bench/contour_distance.h"
#include "tools/bench/surface_distance.h"

using namespace lamina;
using engine::Vector2;
using engine::Vector3;

namespace {

struct HardSection {
  std::string file;
  double z = 0.0;        ///< mm
  double epsilon = 0.0;  ///< mm
  Vector2 place;         ///< on the model, which a contour has to pass
};

}  // namespace

TEST_CASE("contours keep to the model, and the model to the contours, where it is hard", "[corpus]") {
  if (!tests::corpus_present()) {
    WARN("the model corpus is not there: skipped");
    return;
  }
  const HardSection sections[] = {
      // A spline that ran past its end and back to it, near every node of the chain.
      {"seed/skullmask1260.igs", 45.7, 0.05, {0.708, 0.0}},
      {"seed/skullmask1260.igs", 39.5, 0.01, {0.0563, 0.0}},
      // The tip of a fold, thinner than its chords are exact.
      {"seed/bust601_gaps.igs", 38.10009, 0.01, {4.659557, 31.190378}},
      // A trimmed patch on which Newton's method alone finds a wrong foot.
      {"real/DTMB-5415_bulbous_bow.iges", -345.789649, 0.05, {-2636.929352, 14.200556}},
  };
  for (const HardSection& hard : sections) {
    CAPTURE(hard.file, hard.z, hard.epsilon);
    const engine::Model model = engine::read_model(tests::corpus_file(hard.file)).model;
    engine::SliceOptions options;
    options.epsilon = hard.epsilon;
    engine::Slicer slicer(model, {{hard.z, hard.z, hard.z}}, options);
    const auto layer = slicer.next();
    REQUIRE(layer);
    tools::SurfaceDistance surfaces(model);
    surfaces.select_plane(hard.z, 2.0 * hard.epsilon);
    double greatest = 0.0;
    for (const engine::PieceCurve* curve : tools::curves_of(*layer)) {
      for (const Vector2& point : engine::sample_evenly(*curve, 0.02)) {
        bool bridged = false;
        for (const engine::BridgedGap& gap : layer->report.bridged_gaps)
          bridged = bridged || (point - 0.5 * (gap.from + gap.to)).norm() <= 0.5 * gap.width() + hard.epsilon;
        if (bridged) continue;
        const double distance = surfaces.distance(Vector3(point.x(), point.y(), hard.z),
                                                  {0.02 * hard.epsilon, 0.1 * hard.epsilon});
        greatest = std::max(greatest, distance);
      }
    }
    CHECK(greatest < hard.epsilon);
    CHECK(tools::ContourDistance(*layer, 0.02 * hard.epsilon).distance(hard.place, 0.0) < 1.5 * hard.epsilon);
  }
}
