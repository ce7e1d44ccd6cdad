#include "tools/cli/failure.h"

#include <exception>
#include <iostream>
#include <new>

#include "engine/import/import_error.h"
#include "engine/slicer.h"
#include "gcode/marlin/template.h"
#include "gcode/plan/plan_error.h"
#include "gcode/print_volume.h"
#include "profiles/profile_error.h"
#include "tools/cli/interrupt.h"
#include "transport/port/port.h"
#include "transport/session/journal.h"

namespace lamina::tools {
namespace {

constexpr int kSignalBase = 128;

int say(ExitCode code, const std::string& message, const std::string& hint = {}) {
  std::cerr << "error: " << message << '\n';
  if (!hint.empty()) std::cerr << "hint: " << hint << '\n';
  return static_cast<int>(code);
}

}  // namespace

int report_failure() {
  try {
    throw;
  } catch (const Failure& error) {
    return say(error.code, error.what(), error.hint);
  } catch (const Interrupted& error) {
    std::cerr << error.what() << '\n';
    return kSignalBase + error.signal;
  } catch (const engine::ImportError& error) {
    return say(ExitCode::kInput, error.what());
  } catch (const engine::SliceError& error) {
    return say(ExitCode::kGeometry, error.what());
  } catch (const profiles::ProfileError& error) {
    return say(ExitCode::kProfile, error.what());
  } catch (const gcode::TemplateError& error) {
    return say(ExitCode::kProfile, error.what());
  } catch (const gcode::PlanError& error) {
    return say(ExitCode::kProfile, error.what());
  } catch (const gcode::FitError& error) {
    return say(ExitCode::kFit, error.what());
  } catch (const transport::JournalError& error) {
    return say(ExitCode::kInput, error.what());
  } catch (const transport::PortError& error) {
    return say(ExitCode::kPort, error.what());
  } catch (const std::bad_alloc&) {
    return say(ExitCode::kInternal, "out of memory");
  } catch (const std::exception& error) {
    return say(ExitCode::kInternal, error.what());
  }
}

}  // namespace lamina::tools
