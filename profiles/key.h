#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "profiles/profile_error.h"
#include "profiles/settings.h"
#include "profiles/value.h"

namespace lamina::profiles {

enum class ValueType {
  kNumber,
  kInteger,
  kBoolean,
  kText,    ///< One line of printable ASCII: it may end up in a comment of the G-code.
  kGcode,   ///< Lines of G-code, ASCII.
  kChoice,  ///< One of the key's choices.
};

/// Closed at both ends, unless `low_excluded`.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;
};

/// One setting: what it is called, what it takes, and where it goes.
struct Key {
  std::string name;  ///< Dotted, such as "infill.density".
  ValueType type = ValueType::kNumber;
  std::string unit;  ///< Of a number, such as "mm" or "%"; empty without one.
  Bounds bounds;     ///< Of a number or integer.
  std::vector<std::string> choices;
  std::string meaning;  ///< One phrase.

  /// Puts a checked value into the option struct it belongs to.
  std::function<void(Settings&, const Value&)> store;
  /// Reads it back from there.
  std::function<Value(const Settings&)> load;
};

/// What the key accepts, in words: "a number above 0, at most 5 mm", "lines or grid".
std::string accepted(const Key& key);

/// The value in the key's own type (an integer becomes a number where one is wanted). Throws ProfileError
/// naming origin, value and bound when it has the wrong type or is out of range.
Value checked(const Key& key, const Value& value, const Origin& origin);

/// The value that a command line wrote as text. Throws ProfileError as `checked` does.
Value parsed(const Key& key, const std::string& text, const Origin& origin);

}  // namespace lamina::profiles
