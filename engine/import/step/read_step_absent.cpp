// Takes the place of read_step.cpp where OpenCASCADE is not found.

#include "engine/import/import_error.h"
#include "engine/import/step/read_step.h"

namespace lamina::engine {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& format) {
  throw ImportError({.file = file},
                    "holds " + format + ", and this lamina was built without OpenCASCADE to read it",
                    "install libocct-data-exchange-dev and build again, or export the model as IGES");
}

}  // namespace

ImportResult read_step(std::string_view, const std::string& file) {
  refuse(file, "STEP");
}

ImportResult read_brep(std::string_view, const std::string& file) {
  refuse(file, "an OpenCASCADE shape");
}

}  // namespace lamina::engine
