#include "gcode/marlin/template.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gcode/marlin/number_text.h"

namespace lamina::gcode {
namespace {

constexpr int kDecimals = 3;

std::string value_text(const TemplateValue& value) {
  if (const double* number = std::get_if<double>(&value)) {
    if (!std::isfinite(*number)) throw ExpressionError("the value is not finite");
    return number_text(*number, kDecimals);
  }
  return std::get<std::string>(value);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// One `{if}` that is still open.
struct Condition {
  bool holds = false;  ///< Text is kept at the moment, as far as this condition goes.
  bool has_else = false;
  std::size_t line = 0;
};

class Filler {
 public:
  Filler(const std::string& name, const TemplateVariables& variables) : name_(name), variables_(variables) {}

  std::vector<std::string> fill(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      const std::string filled = fill_line(text.substr(0, end));
      if (const std::string_view kept = trimmed(filled); !kept.empty()) lines.emplace_back(kept);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (!open_.empty()) throw TemplateError(name_, open_.back().line, "if", "{if} without {endif}");
    return lines;
  }

 private:
  std::string fill_line(std::string_view line) {
    std::string filled;
    while (!line.empty()) {
      const std::size_t stop = std::min(line.find_first_of("{;"), line.size());
      if (kept()) filled += line.substr(0, stop);
      line.remove_prefix(stop);
      if (line.empty()) break;
      if (line.front() == ';') {
        if (kept()) filled += line;
        break;
      }
      const std::size_t close = line.find('}');
      if (close == std::string_view::npos) fail(line.substr(1), "'}' is missing");
      filled += placeholder(trimmed(line.substr(1, close - 1)));
      line.remove_prefix(close + 1);
    }
    return filled;
  }

  std::string placeholder(std::string_view text) {
    try {
      if (text == "endif") {
        if (open_.empty()) fail(text, "{endif} without {if}");
        open_.pop_back();
      } else if (text == "else") {
        if (open_.empty() || open_.back().has_else) fail(text, "{else} without {if}");
        open_.back().has_else = true;
        open_.back().holds = !open_.back().holds;
      } else if (text.starts_with("if ")) {
        // Inside a part that is left out nothing is evaluated.
        const bool holds = kept() && is_true(evaluate(text.substr(3), variables_));
        open_.push_back({holds, false, line_});
      } else if (kept()) {
        return value_text(evaluate(text, variables_));
      }
    } catch (const ExpressionError& error) {
      fail(text, error.what());
    }
    return {};
  }

  bool kept() const {
    return std::ranges::all_of(open_, [](const Condition& condition) { return condition.holds; });
  }

  [[noreturn]] void fail(std::string_view text, const std::string& problem) const {
    throw TemplateError(name_, line_, std::string(text), problem);
  }

  const std::string& name_;
  const TemplateVariables& variables_;
  std::vector<Condition> open_;
  std::size_t line_ = 0;
};

}  // namespace

TemplateError::TemplateError(const std::string& name, std::size_t line_number, const std::string& text,
                             const std::string& problem)
    : std::runtime_error(name + ", line " + std::to_string(line_number) + ": {" + text + "}: " + problem),
      template_name(name),
      line(line_number),
      placeholder(text) {}

std::vector<std::string> fill_template(const std::string& name, std::string_view text,
                                       const TemplateVariables& variables) {
  return Filler(name, variables).fill(text);
}

}  // namespace lamina::gcode
