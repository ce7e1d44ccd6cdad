#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/import/import_error.h"
#include "engine/import/inspect/boundary_report.h"
#include "engine/import/inspect/trimmed_area.h"
#include "engine/import/read_model.h"
#include "engine/import/step/read_step.h"
#include "engine/model_bounds.h"
#include "tests/support/corpus.h"
#include "tests/support/manifest.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

std::string error_reading(const std::string& bytes) {
  try {
    read_step(bytes, "part.stp");
  } catch (const ImportError& error) {
    return error.what();
  }
  return {};
}

bool has_opencascade() {
  return error_reading("ISO-10303-21;").find("without OpenCASCADE") == std::string::npos;
}

}  // namespace

TEST_CASE("STEP: recognised by content; what is damaged, or cannot be read here, is one clear error") {
  CHECK(looks_like_step("ISO-10303-21;\nHEADER;"));
  CHECK(looks_like_step("\xef\xbb\xbf\r\n ISO-10303-21;"));
  CHECK_FALSE(looks_like_step("solid ISO-10303-21"));
  CHECK(looks_like_brep("\nCASCADE Topology V1, (c) Matra-Datavision\n"));
  CHECK_FALSE(looks_like_brep(""));
  CHECK(error_reading("ISO-10303-21;\nHEADER;\n").find("part.stp: ") == 0);
}

TEST_CASE("corpus: STEP files have the faces and areas of the manifest, assemblies placed") {
  if (!corpus_present() || !has_opencascade()) {
    WARN("the model corpus or OpenCASCADE is missing: skipped");
    return;
  }
  std::size_t files = 0;
  for (const ManifestRow& cells : manifest_rows({".stp", ".step"})) {
    const std::string& file = cells[1];
    INFO(file);
    const ImportResult result = read_model(corpus_file(file));
    CHECK(result.report.format == "STEP");
    CHECK(result.model.surfaces.size() == std::stoul(cells[6]));
    double area = 0.0;
    for (const Surface& surface : result.model.surfaces) area += surface_integrals(surface).area;
    CHECK(area == Approx(std::stod(cells[9])).epsilon(1e-4));
    Vector3 low;
    Vector3 high;
    std::string dots;
    std::istringstream(cells[4]) >> low.x() >> low.y() >> low.z() >> dots >> high.x() >> high.y() >> high.z();
    const Box3 box = model_bounds(result.model);
    CHECK((box.min() - low).cwiseAbs().maxCoeff() < 2e-3);
    CHECK((box.max() - high).cwiseAbs().maxCoeff() < 2e-3);
    ++files;
  }
  CHECK(files >= 8);
}

TEST_CASE("STEP: an assembly closes solid by solid, and its volume is theirs together") {
  if (!corpus_present() || !has_opencascade()) {
    WARN("the model corpus or OpenCASCADE is missing: skipped");
    return;
  }
  const BoundaryReport report = boundary_report(read_model(corpus_file("real/as1-tu-203.stp")).model);
  CHECK(report.is_closed());
  // Its bolts fill holes and its parts touch: along many edges more than two faces meet.
  CHECK(report.volume.value_or(0.0) == Approx(764518.03).epsilon(2e-5));
}
