#include "profiles/nearest_name.h"

#include <catch2/catch.hpp>

#include "profiles/value.h"

using namespace lamina::profiles;

TEST_CASE("the nearest name: one slip is found, a stranger is not") {
  const std::vector<std::string> names{"slice", "print", "emulate", "contours", "info", "profiles"};
  CHECK(nearest_name("slcie", names) == "slice");   // swapped
  CHECK(nearest_name("slic", names) == "slice");    // left out
  CHECK(nearest_name("pprint", names) == "print");  // doubled
  CHECK(nearest_name("conturs", names) == "contours");
  CHECK(nearest_name("profile", names) == "profiles");
  CHECK(nearest_name("inf", names) == "info");
  CHECK(nearest_name("weld", names).empty());
  CHECK(nearest_name("", names).empty());
  CHECK(nearest_name("x", {}).empty());
  CHECK(suggestion("slcie", names) == "did you mean 'slice'?");
  CHECK(suggestion("weld", names, "no such verb") == "no such verb");
}

TEST_CASE("values as TOML") {
  CHECK(to_toml(Value(true)) == "true");
  CHECK(to_toml(Value(std::int64_t{-3})) == "-3");
  CHECK(to_toml(Value(0.1)) == "0.1");
  CHECK(to_toml(Value(220.0)) == "220");
  CHECK(to_toml(Value(1e20)) == "1e+20");
  CHECK(to_toml(Value(std::string("a \"b\"\n\\"))) == R"("a \"b\"\n\\")");
}
