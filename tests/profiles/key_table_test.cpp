#include "profiles/key_table.h"

#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "profiles/resolve.h"

using namespace lamina::profiles;

namespace {

/// A valid value that is not the default.
Value other_value(const Key& key) {
  const Value current = key.load(Settings{});
  switch (key.type) {
    case ValueType::kNumber: {
      const double half_way = key.bounds.low + 0.375 * (key.bounds.high - key.bounds.low);
      return half_way == std::get<double>(current) ? key.bounds.high : half_way;
    }
    case ValueType::kInteger: {
      const auto high = static_cast<std::int64_t>(key.bounds.high);
      return std::get<std::int64_t>(current) == high ? high - 1 : high;
    }
    case ValueType::kBoolean:
      return !std::get<bool>(current);
    case ValueType::kText:
    case ValueType::kGcode:
      return std::get<std::string>(current) + " other";
    case ValueType::kChoice:
      for (const std::string& choice : key.choices) {
        if (Value(choice) != current) return choice;
      }
  }
  return current;
}

std::string as_written(const Value& value) {
  if (const std::string* text = std::get_if<std::string>(&value)) return *text;
  return to_toml(value);
}

}  // namespace

TEST_CASE("keys are unique and say what they take") {
  std::set<std::string> names;
  for (const Key& key : key_table()) {
    INFO(key.name);
    CHECK(names.insert(key.name).second);
    CHECK_FALSE(key.meaning.empty());
    CHECK(std::count(key.name.begin(), key.name.end(), '.') >= 1);
    if (key.type == ValueType::kNumber || key.type == ValueType::kInteger) {
      CHECK(key.bounds.low < key.bounds.high);
      CHECK(std::isfinite(key.bounds.high));
    }
    if (key.type == ValueType::kChoice) CHECK(key.choices.size() >= 2);
  }
}

TEST_CASE("each key is settable, lands in its struct, and touches no other key") {
  for (const Key& key : key_table()) {
    INFO(key.name);
    Settings settings;
    const Value value = other_value(key);
    REQUIRE_FALSE(value == key.load(settings));
    key.store(settings, checked(key, value, {}));
    const Value stored = key.load(settings);
    if (key.type == ValueType::kNumber) {
      CHECK(std::get<double>(stored) == Approx(std::get<double>(value)).epsilon(1e-12));
    } else {
      CHECK(stored == value);
    }
    for (const Key& bystander : key_table()) {
      if (bystander.name == key.name) continue;
      INFO("bystander " << bystander.name);
      CHECK(bystander.load(settings) == bystander.load(Settings{}));
    }
  }
}

TEST_CASE("each key can be given on the command line and arrives") {
  const ProfileStore store;
  for (const Key& key : key_table()) {
    INFO(key.name);
    const Value value = other_value(key);
    ProfileChoice choice;
    choice.assignments.push_back(parse_assignment(key.name + "=" + as_written(value)));
    const ResolvedProfile resolved = resolve(store, choice);
    CHECK(resolved.at(key.name).value == value);
    CHECK(key.load(resolved.settings) == checked(key, value, {}));
  }
}

TEST_CASE("the built-in defaults are within their own bounds") {
  for (const Key& key : key_table()) {
    INFO(key.name);
    CHECK_NOTHROW(checked(key, key.load(Settings{}), {}));
  }
}

TEST_CASE("a value just outside the bounds is refused, the bound itself is not") {
  for (const Key& key : key_table()) {
    INFO(key.name);
    if (key.type == ValueType::kNumber) {
      const double infinity = std::numeric_limits<double>::infinity();
      CHECK_NOTHROW(checked(key, key.bounds.high, {}));
      CHECK_THROWS_AS(checked(key, std::nextafter(key.bounds.high, infinity), {}), ProfileError);
      CHECK_THROWS_AS(checked(key, std::nextafter(key.bounds.low, -infinity), {}), ProfileError);
      if (key.bounds.low_excluded) {
        CHECK_THROWS_AS(checked(key, key.bounds.low, {}), ProfileError);
      } else {
        CHECK_NOTHROW(checked(key, key.bounds.low, {}));
      }
    } else if (key.type == ValueType::kInteger) {
      CHECK_THROWS_AS(checked(key, static_cast<std::int64_t>(key.bounds.high) + 1, {}), ProfileError);
      CHECK_THROWS_AS(checked(key, static_cast<std::int64_t>(key.bounds.low) - 1, {}), ProfileError);
    }
  }
}

TEST_CASE("percent in the profile is a share in the struct") {
  Settings settings;
  const Key& key = find_key("infill.density", {});
  key.store(settings, 7.0);
  CHECK(settings.gcode.plan.infill.density == 0.07);
  CHECK(to_toml(key.load(settings)) == "7");
}
