#pragma once

namespace lamina::tools {

/// What the program tells the shell. A signal ends it with 128 + its number (130 for Ctrl-C, 143 for
/// SIGTERM).
enum class ExitCode : int {
  kOk = 0,
  kInternal = 1,   ///< A defect of lamina, or the system failed (no memory, disk full).
  kUsage = 2,      ///< A wrong verb, option or argument.
  kInput = 3,      ///< A file that cannot be read, or is of no known kind.
  kGeometry = 4,   ///< The model was read, and cannot be sliced.
  kProfile = 5,    ///< A wrong profile or setting.
  kFit = 6,        ///< The model does not fit the printer.
  kPort = 7,       ///< No port, or no printer at its other end.
  kPrinter = 8,    ///< The printer failed while printing.
  kCancelled = 9,  ///< The print was cancelled at the printer.
};

inline constexpr const char* kExitCodesHelp =
    "Exit codes: 0 done, 1 internal error or disk full, 2 wrong usage, 3 input not readable, 4 model cannot "
    "be\n"
    "sliced, 5 wrong profile or setting, 6 does not fit the printer, 7 port, 8 printer error, 9 cancelled "
    "at\n"
    "the printer, 130 Ctrl-C, 143 terminated.";

}  // namespace lamina::tools
