#include "tests/tools/program_run.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <sys/wait.h>
#include <unistd.h>

namespace lamina::tests {

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

WorkFolder::WorkFolder() {
  static int count = 0;
  std::ostringstream name;
  name << "lamina_cli_" << getpid() << '_' << count++;
  path_ = std::filesystem::temp_directory_path() / name.str();
  std::filesystem::create_directories(path_);
}

WorkFolder::~WorkFolder() {
  std::filesystem::remove_all(path_);
}

std::vector<std::string> WorkFolder::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    if (name != ".stdout" && name != ".stderr") names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

ProgramRun run_shell(const WorkFolder& folder, const std::string& command) {
  std::ostringstream script;
  script << "cd '" << folder.path().string()
         << "' && unset LAMINA_PROFILE_PATH SOURCE_DATE_EPOCH && export LAMINA='" << LAMINA_PROGRAM
         << "' && (" << command << ") > .stdout 2> .stderr";
  const int status = std::system(script.str().c_str());
  if (status == -1 || !WIFEXITED(status)) throw std::runtime_error("cannot run: " + command);
  return {WEXITSTATUS(status), read_text(folder / ".stdout"), read_text(folder / ".stderr")};
}

ProgramRun run_lamina(const WorkFolder& folder, const std::string& arguments) {
  return run_shell(folder, "\"$LAMINA\" " + arguments);
}

ProgramRun interrupt_lamina(const WorkFolder& folder, const std::string& arguments, const std::string& sign,
                            const std::string& signal) {
  // A shell without job control lets its background jobs ignore SIGINT; env takes that back.
  std::ostringstream command;
  command << "env --default-signal=INT \"$LAMINA\" " << arguments
          << " & lamina=$!; for i in $(seq 600); do grep -q '" << sign
          << "' .stderr && break; sleep 0.1; done; kill -" << signal << " $lamina; wait $lamina";
  return run_shell(folder, command.str());
}

std::string model_file(const std::string& name) {
  return std::string(LAMINA_SOURCE_DIR) + "/tests/tools/data/" + name;
}

}  // namespace lamina::tests
