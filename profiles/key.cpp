#include "profiles/key.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "profiles/nearest_name.h"

namespace lamina::profiles {
namespace {

std::string range_text(const Key& key) {
  const Bounds& bounds = key.bounds;
  const bool low = std::isfinite(bounds.low);
  const bool high = std::isfinite(bounds.high);
  const std::string unit = key.unit.empty() ? "" : " " + key.unit;
  if (bounds.low_excluded && high) {
    return fmt::format("above {}, at most {}{}", number_text(bounds.low), number_text(bounds.high), unit);
  }
  if (bounds.low_excluded) return fmt::format("above {}{}", number_text(bounds.low), unit);
  if (low && high)
    return fmt::format("from {} to {}{}", number_text(bounds.low), number_text(bounds.high), unit);
  if (low) return fmt::format("at least {}{}", number_text(bounds.low), unit);
  return key.unit.empty() ? "" : "in " + key.unit;
}

bool in_range(const Bounds& bounds, double number) {
  return (bounds.low_excluded ? number > bounds.low : number >= bounds.low) && number <= bounds.high;
}

[[noreturn]] void refuse(const Key& key, const std::string& written, const Origin& origin,
                         std::string hint = {}) {
  ProfileError::Fields fields;
  fields.origin = origin;
  fields.key = key.name;
  fields.value = written;
  fields.bound = accepted(key);
  fields.problem = fmt::format("{} is {}: it must be {}", key.name, written, fields.bound);
  fields.hint = std::move(hint);
  throw ProfileError(std::move(fields));
}

bool is_printable(char c) {
  return c >= ' ' && c <= '~';
}

bool fits_text(const Key& key, const std::string& text) {
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return is_printable(c) || (key.type == ValueType::kGcode && (c == '\n' || c == '\t'));
  });
}

template <class Number>
bool parse_number(const std::string& text, Number& number) {
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  return result.ec == std::errc() && result.ptr == end;
}

}  // namespace

std::string accepted(const Key& key) {
  switch (key.type) {
    case ValueType::kNumber:
    case ValueType::kInteger: {
      const std::string kind = key.type == ValueType::kInteger ? "an integer" : "a number";
      const std::string range = range_text(key);
      return range.empty() ? kind : kind + " " + range;
    }
    case ValueType::kBoolean:
      return "true or false";
    case ValueType::kText:
      return "one line of ASCII text";
    case ValueType::kGcode:
      return "ASCII text";
    case ValueType::kChoice:
      return fmt::format("{}", fmt::join(key.choices, " or "));
  }
  return {};
}

Value checked(const Key& key, const Value& value, const Origin& origin) {
  const std::string written = to_toml(value);
  switch (key.type) {
    case ValueType::kNumber: {
      double number = 0.0;
      if (const double* given = std::get_if<double>(&value)) {
        number = *given;
      } else if (const std::int64_t* integer = std::get_if<std::int64_t>(&value)) {
        number = static_cast<double>(*integer);
      } else {
        refuse(key, written, origin);
      }
      if (!std::isfinite(number) || !in_range(key.bounds, number)) refuse(key, written, origin);
      return number;
    }
    case ValueType::kInteger: {
      const std::int64_t* integer = std::get_if<std::int64_t>(&value);
      if (integer == nullptr || !in_range(key.bounds, static_cast<double>(*integer)))
        refuse(key, written, origin);
      return value;
    }
    case ValueType::kBoolean:
      if (!std::holds_alternative<bool>(value)) refuse(key, written, origin);
      return value;
    case ValueType::kText:
    case ValueType::kGcode: {
      const std::string* text = std::get_if<std::string>(&value);
      if (text == nullptr || !fits_text(key, *text)) refuse(key, written, origin);
      return value;
    }
    case ValueType::kChoice: {
      const std::string* text = std::get_if<std::string>(&value);
      if (text == nullptr) refuse(key, written, origin);
      if (std::find(key.choices.begin(), key.choices.end(), *text) == key.choices.end()) {
        refuse(key, written, origin, suggestion(*text, key.choices));
      }
      return value;
    }
  }
  return value;
}

Value parsed(const Key& key, const std::string& text, const Origin& origin) {
  Value value = text;
  if (key.type == ValueType::kNumber) {
    double number = 0.0;
    if (parse_number(text, number)) value = number;
  } else if (key.type == ValueType::kInteger) {
    std::int64_t integer = 0;
    if (parse_number(text, integer)) value = integer;
  } else if (key.type == ValueType::kBoolean && (text == "true" || text == "false")) {
    value = text == "true";
  }
  return checked(key, value, origin);
}

}  // namespace lamina::profiles
