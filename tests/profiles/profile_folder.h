#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace lamina::tests {

/// A folder of profiles that a test writes itself; gone with the object.
class ProfileFolder {
 public:
  ProfileFolder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("lamina_profiles_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    for (const char* kind : {"printers", "filaments", "qualities"}) {
      std::filesystem::create_directories(path_ / kind);
    }
  }
  ProfileFolder(const ProfileFolder&) = delete;
  ProfileFolder& operator=(const ProfileFolder&) = delete;
  ~ProfileFolder() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

  /// Writes a file such as "qualities/mine.toml".
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }

  /// A quality profile called `name` with these lines behind its four header lines.
  void write_quality(const std::string& name, const std::string& body, const std::string& parent = {}) const {
    write("qualities/" + name + ".toml", "schema = 1\nkind = \"quality\"\nname = \"" + name + "\"\n" +
                                             (parent.empty() ? "\n" : "inherits = \"" + parent + "\"\n") +
                                             body);
  }

 private:
  std::filesystem::path path_;
};

}  // namespace lamina::tests
