#include "gcode/marlin/expression.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>
#include <vector>

#include "gcode/marlin/number_text.h"

namespace lamina::gcode {
namespace {

/// Deep enough for any sane template, shallow enough for the stack.
constexpr int kMaxDepth = 100;

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
}

std::string names_of(const TemplateVariables& variables) {
  std::string names;
  for (const auto& [name, value] : variables) names += (names.empty() ? "" : ", ") + name;
  return names;
}

/// Recursive descent, one function per level of precedence.
class Evaluator {
 public:
  Evaluator(std::string_view text, const TemplateVariables& variables) : text_(text), variables_(variables) {}

  TemplateValue whole() {
    TemplateValue value = disjunction();
    skip_blanks();
    if (at_ < text_.size()) fail("unexpected '" + std::string(text_.substr(at_)) + "'");
    return value;
  }

 private:
  TemplateValue disjunction() {
    TemplateValue value = conjunction();
    while (take_word("or")) {
      const TemplateValue right = conjunction();
      value = is_true(value) || is_true(right) ? 1.0 : 0.0;
    }
    return value;
  }

  TemplateValue conjunction() {
    TemplateValue value = negation();
    while (take_word("and")) {
      const TemplateValue right = negation();
      value = is_true(value) && is_true(right) ? 1.0 : 0.0;
    }
    return value;
  }

  TemplateValue negation() {
    if (++depth_ > kMaxDepth) fail("too deeply nested");
    TemplateValue value = 0.0;
    if (take_word("not")) {
      value = is_true(negation()) ? 0.0 : 1.0;
    } else {
      value = comparison();
    }
    --depth_;
    return value;
  }

  TemplateValue comparison() {
    TemplateValue left = sum();
    if (take("==")) return left == sum() ? 1.0 : 0.0;
    if (take("!=")) return left == sum() ? 0.0 : 1.0;
    if (take("<=")) return number(left) <= number(sum()) ? 1.0 : 0.0;
    if (take(">=")) return number(left) >= number(sum()) ? 1.0 : 0.0;
    if (take("<")) return number(left) < number(sum()) ? 1.0 : 0.0;
    if (take(">")) return number(left) > number(sum()) ? 1.0 : 0.0;
    return left;
  }

  TemplateValue sum() {
    TemplateValue value = product();
    while (true) {
      if (take("+")) {
        value = number(value) + number(product());
      } else if (take("-")) {
        value = number(value) - number(product());
      } else {
        return value;
      }
    }
  }

  TemplateValue product() {
    TemplateValue value = signed_value();
    while (true) {
      if (take("*")) {
        value = number(value) * number(signed_value());
      } else if (take("/")) {
        const double divisor = number(signed_value());
        if (divisor == 0.0) fail("division by zero");
        value = number(value) / divisor;
      } else {
        return value;
      }
    }
  }

  TemplateValue signed_value() {
    if (++depth_ > kMaxDepth) fail("too deeply nested");
    TemplateValue value = 0.0;
    if (take("-")) {
      value = -number(signed_value());
    } else {
      value = primary();
    }
    --depth_;
    return value;
  }

  TemplateValue primary() {
    skip_blanks();
    if (at_ >= text_.size()) fail("a value is missing");
    if (take("(")) {
      TemplateValue value = disjunction();
      expect(")");
      return value;
    }
    if (text_[at_] == '"') return quoted();
    if (const auto read = read_number(text_.substr(at_))) {
      at_ += read->size;
      return read->value;
    }
    const std::string name = this->name();
    if (name.empty()) fail("unexpected '" + std::string(text_.substr(at_)) + "'");
    if (take("(")) return function(name);
    const auto variable = variables_.find(name);
    if (variable == variables_.end()) {
      fail("unknown name '" + name + "'; known names: " + names_of(variables_));
    }
    return variable->second;
  }

  TemplateValue quoted() {
    const std::size_t end = text_.find('"', at_ + 1);
    if (end == std::string_view::npos) fail("a text is not closed");
    std::string value(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return value;
  }

  TemplateValue function(const std::string& name) {
    std::vector<double> arguments{number(disjunction())};
    while (take(",")) arguments.push_back(number(disjunction()));
    expect(")");
    if (name == "min") return std::ranges::min(arguments);
    if (name == "max") return std::ranges::max(arguments);
    if (arguments.size() != 1) fail("function '" + name + "' is unknown or takes one argument");
    if (name == "abs") return std::abs(arguments.front());
    if (name == "floor") return std::floor(arguments.front());
    if (name == "ceil") return std::ceil(arguments.front());
    if (name == "round") return std::round(arguments.front());
    fail("unknown function '" + name + "'; known functions: abs, ceil, floor, max, min, round");
  }

  double number(const TemplateValue& value) const {
    if (const double* number = std::get_if<double>(&value)) return *number;
    fail("\"" + std::get<std::string>(value) + "\" is a text, not a number");
  }

  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name_character(text_[at_])) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  bool take(std::string_view symbol) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(symbol)) return false;
    at_ += symbol.size();
    return true;
  }

  bool take_word(std::string_view word) {
    skip_blanks();
    const std::string_view rest = text_.substr(at_);
    if (!rest.starts_with(word)) return false;
    if (rest.size() > word.size() && is_name_character(rest[word.size()])) return false;
    at_ += word.size();
    return true;
  }

  void expect(std::string_view symbol) {
    if (!take(symbol)) fail("'" + std::string(symbol) + "' is missing");
  }

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  [[noreturn]] void fail(const std::string& problem) const { throw ExpressionError(problem); }

  std::string_view text_;
  const TemplateVariables& variables_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

TemplateValue evaluate(std::string_view expression, const TemplateVariables& variables) {
  return Evaluator(expression, variables).whole();
}

bool is_true(const TemplateValue& value) {
  if (const double* number = std::get_if<double>(&value)) return *number != 0.0;
  return !std::get<std::string>(value).empty();
}

}  // namespace lamina::gcode
