#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lamina::tests {

std::string read_text(const std::filesystem::path& path);

/// A folder to run the program in; gone with the object.
class WorkFolder {
 public:
  WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder();

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

  /// Names of the files in it, sorted, those of the test itself left out.
  std::vector<std::string> files() const;

 private:
  std::filesystem::path path_;
};

struct ProgramRun {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs a shell command in the folder; $LAMINA is the program under test. The environment is the test's own
/// but for LAMINA_PROFILE_PATH and SOURCE_DATE_EPOCH, which are unset.
ProgramRun run_shell(const WorkFolder& folder, const std::string& command);

/// `lamina` with these arguments.
ProgramRun run_lamina(const WorkFolder& folder, const std::string& arguments);

/// `lamina` with these arguments, sent a signal ("INT", "TERM") as soon as stderr holds `sign`, at most a
/// minute later.
ProgramRun interrupt_lamina(const WorkFolder& folder, const std::string& arguments, const std::string& sign,
                            const std::string& signal);

/// A small model beside this test.
std::string model_file(const std::string& name);

}  // namespace lamina::tests
