#pragma once

#include <stdexcept>
#include <string>

#include "tools/cli/exit_codes.h"

namespace lamina::tools {

/// Something that the program itself has to refuse, with the code it ends with. Errors of the stages have
/// their own types; see `report_failure`.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode exit_code, const std::string& message, std::string what_to_do = {})
      : std::runtime_error(message), code(exit_code), hint(std::move(what_to_do)) {}

  ExitCode code;
  std::string hint;  ///< What to do; empty without one.
};

/// Says on stderr what went wrong ("error: ...", perhaps "hint: ...") and returns the program's exit status.
/// Call it inside a catch block.
int report_failure();

}  // namespace lamina::tools
