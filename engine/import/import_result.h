#pragma once

#include "engine/import/import_report.h"
#include "engine/model.h"

namespace lamina::engine {

/// A model as read, in mm, and the report of reading it.
struct ImportResult {
  Model model;
  ImportReport report;
};

}  // namespace lamina::engine
