#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace lamina::profiles {

/// Where a value was written: a place in a file, an option of the command line, or nowhere (the built-in
/// default).
struct Origin {
  std::string source;      ///< File as it was found, or "-s infill.density=20"; empty = built-in default.
  std::size_t line = 0;    ///< 1-based; 0 outside a file.
  std::size_t column = 0;  ///< 1-based; 0 outside a file.
};

/// "file.toml:12:9", "-s infill.density=20", or "default".
std::string to_text(const Origin& origin);

/// A profile is missing, cannot be read, or says something impossible. `what()` is one line: place, key,
/// value, bound, and what to do.
class ProfileError : public std::runtime_error {
 public:
  struct Fields {
    Origin origin;
    std::string problem;  ///< One phrase.
    std::string key;      ///< Dotted; empty where it is not about a key.
    std::string value;    ///< As written; empty without one.
    std::string bound;    ///< What would be right, such as "0 to 100 %".
    std::string hint;     ///< Such as "did you mean 'infill.density'?".
  };

  explicit ProfileError(Fields fields);

  const Fields& fields() const { return fields_; }

 private:
  Fields fields_;
};

}  // namespace lamina::profiles
