#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace lamina::engine {

/// Where in a model file something is wrong. What does not apply is empty or 0.
struct ImportPlace {
  std::string file{};
  std::string section{};           ///< such as "directory"
  std::size_t line = 0;            ///< line of that section, counted from 1
  int entity_type = 0;             ///< IGES type number, such as 128
  std::size_t directory_line = 0;  ///< line of the directory section where the entity is declared
};

/// A model file cannot be read. The message is one line: file, place, problem and, where there is one, a hint
/// what to do.
class ImportError : public std::runtime_error {
 public:
  ImportError(ImportPlace place, const std::string& problem, std::string hint = {});

  const ImportPlace& place() const { return place_; }
  const std::string& hint() const { return hint_; }

 private:
  ImportPlace place_;
  std::string hint_;
};

}  // namespace lamina::engine
