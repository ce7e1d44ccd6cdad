#include <string>
#include <vector>

#include "tools/cli/command_line.h"
#include "tools/cli/failure.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/verbs.h"

int main(int argc, char** argv) {
  using namespace lamina::tools;
  try {
    catch_interrupts();
    const std::vector<std::string> arguments(argv, argv + argc);
    return run_command_line(
        arguments,
        {slice_verb(), print_verb(), emulate_verb(), contours_verb(), info_verb(), profiles_verb(),
         sd_verb(), ports_verb(), replay_verb()},
        LAMINA_VERSION);
  } catch (...) {
    return report_failure();
  }
}
