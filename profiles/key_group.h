#pragma once

#include <cmath>
#include <concepts>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "profiles/key.h"

namespace lamina::profiles {

/// Makes the keys of one option struct: `name` is their table in the profile files, `find` leads to the
/// struct. A key is then declared by the member it fills.
template <class Options>
class KeyGroup {
 public:
  KeyGroup(std::string name, std::function<Options&(Settings&)> find)
      : name_(std::move(name)), find_(std::move(find)) {}

  /// A number as the struct holds it.
  Key number(const std::string& key, double Options::*member, std::string unit, Bounds bounds,
             std::string meaning) const {
    return scaled(key, member, std::move(unit), bounds, std::move(meaning), 1.0);
  }

  /// Percent in the profile, a share in the struct.
  Key percent(const std::string& key, double Options::*member, Bounds bounds, std::string meaning) const {
    return scaled(key, member, "%", bounds, std::move(meaning), 100.0);
  }

  template <std::integral Integer>
  Key integer(const std::string& key, Integer Options::*member, std::string unit, Bounds bounds,
              std::string meaning) const {
    Key result = make(key, ValueType::kInteger, std::move(meaning), member);
    result.unit = std::move(unit);
    result.bounds = bounds;
    result.store = [find = find_, member](Settings& settings, const Value& value) {
      find(settings).*member = static_cast<Integer>(std::get<std::int64_t>(value));
    };
    return result;
  }

  Key boolean(const std::string& key, bool Options::*member, std::string meaning) const {
    Key result = make(key, ValueType::kBoolean, std::move(meaning), member);
    result.store = [find = find_, member](Settings& settings, const Value& value) {
      find(settings).*member = std::get<bool>(value);
    };
    return result;
  }

  Key text(const std::string& key, std::string Options::*member, std::string meaning) const {
    return string(key, ValueType::kText, member, std::move(meaning));
  }

  Key gcode(const std::string& key, std::string Options::*member, std::string meaning) const {
    return string(key, ValueType::kGcode, member, std::move(meaning));
  }

  /// `choices` name the enumerators in their order, from 0.
  template <class Enum>
  requires std::is_enum_v<Enum> Key choice(const std::string& key, Enum Options::*member,
                                           const std::vector<std::string>& choices, std::string meaning)
  const {
    Key result = make(key, ValueType::kChoice, std::move(meaning), member);
    result.choices = choices;
    result.store = [find = find_, member, choices](Settings& settings, const Value& value) {
      const std::string& chosen = std::get<std::string>(value);
      for (std::size_t index = 0; index < choices.size(); ++index) {
        if (choices[index] == chosen) find(settings).*member = static_cast<Enum>(index);
      }
    };
    result.load = [find = find_, member, choices](const Settings& settings) -> Value {
      Settings copy = settings;
      return choices[static_cast<std::size_t>(find(copy).*member)];
    };
    return result;
  }

 private:
  template <class Member>
  Key make(const std::string& key, ValueType type, std::string meaning, Member Options::*member) const {
    Key result;
    result.name = name_ + "." + key;
    result.type = type;
    result.meaning = std::move(meaning);
    result.load = [find = find_, member](const Settings& settings) -> Value {
      Settings copy = settings;
      if constexpr (!std::same_as<Member, bool> && (std::integral<Member> || std::is_enum_v<Member>)) {
        return static_cast<std::int64_t>(find(copy).*member);
      } else {
        return find(copy).*member;
      }
    };
    return result;
  }

  Key string(const std::string& key, ValueType type, std::string Options::*member,
             std::string meaning) const {
    Key result = make(key, type, std::move(meaning), member);
    result.store = [find = find_, member](Settings& settings, const Value& value) {
      find(settings).*member = std::get<std::string>(value);
    };
    return result;
  }

  Key scaled(const std::string& key, double Options::*member, std::string unit, Bounds bounds,
             std::string meaning, double scale) const {
    Key result = make(key, ValueType::kNumber, std::move(meaning), member);
    result.unit = std::move(unit);
    result.bounds = bounds;
    result.store = [find = find_, member, scale](Settings& settings, const Value& value) {
      find(settings).*member = std::get<double>(value) / scale;
    };
    result.load = [find = find_, member, scale](const Settings& settings) -> Value {
      Settings copy = settings;
      const double number = find(copy).*member * scale;
      // Twelve decimals: what the division by the scale rounded away comes back whole.
      return scale == 1.0 ? number : std::round(number * 1e12) / 1e12;
    };
    return result;
  }

  std::string name_;
  std::function<Options&(Settings&)> find_;
};

}  // namespace lamina::profiles
