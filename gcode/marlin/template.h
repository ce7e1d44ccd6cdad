#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gcode/marlin/expression.h"

namespace lamina::gcode {

/// A G-code template that cannot be filled in.
class TemplateError : public std::runtime_error {
 public:
  TemplateError(const std::string& name, std::size_t line_number, const std::string& text,
                const std::string& problem);

  std::string template_name;
  std::size_t line;         ///< 1-based, within the template.
  std::string placeholder;  ///< As written, without its braces.
};

/// Fills in a template: `{expression}` becomes its value (numbers with at most three decimals), and text
/// between
/// `{if expression}` and `{else}` or `{endif}` stays only when the expression is true; conditions nest. A `{`
/// in a comment is no placeholder. Returns the lines, without line feeds; those that are blank are left out.
/// `name` stands in the errors.
std::vector<std::string> fill_template(const std::string& name, std::string_view text,
                                       const TemplateVariables& variables);

}  // namespace lamina::gcode
