#pragma once

namespace lamina::tools {

/// What `main` of a measurement does: runs it and turns an exception into one line on stderr and exit code 1.
int run_measurement(int (*measurement)(int, char**), int argc, char** argv);

}  // namespace lamina::tools
