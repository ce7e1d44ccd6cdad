#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

namespace lamina::gcode {

using TemplateValue = std::variant<double, std::string>;
using TemplateVariables = std::map<std::string, TemplateValue, std::less<>>;

/// An expression that cannot be evaluated.
class ExpressionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Value of an expression: numbers, "texts", names of variables, + - * /, parentheses, comparisons, and / or
/// / not, and the functions min, max, abs, floor, ceil, round. Comparisons and logic give 1 or 0. Throws
/// ExpressionError for an unknown name (which it lists with those it knows), wrong types, division by zero
/// and bad syntax.
TemplateValue evaluate(std::string_view expression, const TemplateVariables& variables);

/// Whether a value counts as true: a number other than 0, a text that is not empty.
bool is_true(const TemplateValue& value);

}  // namespace lamina::gcode
