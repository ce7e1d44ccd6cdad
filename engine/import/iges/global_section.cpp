#include "engine/import/iges/global_section.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "engine/import/iges/number.h"
#include "engine/import/import_error.h"

namespace lamina::engine {
namespace {

/// Positions of the fields, from 0 (IGES 5.3, table 2).
enum Field : std::size_t {
  kProduct = 2,
  kSystem = 4,
  kPreprocessor = 5,
  kModelScale = 12,
  kUnitFlag = 13,
  kUnitName = 14,
  kResolution = 18,
  kMaxCoordinate = 19,
  kAuthor = 20,
  kOrganization = 21,
  kFieldCount = 26
};

struct FieldText {
  std::string text;
  bool is_string = false;
};

/// A Hollerith string's count and where its characters begin: "4HINCH" gives {4, 2}.
struct HollerithHead {
  std::size_t count = 0;
  std::size_t begin = 0;
};

std::optional<HollerithHead> hollerith_head(std::string_view text, std::size_t at) {
  const std::size_t first = at;
  std::size_t count = 0;
  while (at < text.size() && text[at] >= '0' && text[at] <= '9' && at - first < 6) {
    count = count * 10 + static_cast<std::size_t>(text[at++] - '0');
  }
  if (at == first || at >= text.size() || (text[at] != 'H' && text[at] != 'h')) return std::nullopt;
  return HollerithHead{count, at + 1};
}

/// Cuts the section's text into fields.
class FieldSplitter {
 public:
  FieldSplitter(std::string_view text, bool trust_counts) : text_(text), trust_counts_(trust_counts) {}

  std::vector<FieldText> split() {
    parameter_delimiter_ = delimiter(',');
    record_delimiter_ = delimiter(';');
    malformed_ = ended_;
    std::vector<FieldText> fields(2);
    while (!ended_ && at_ < text_.size() && fields.size() < kFieldCount) fields.push_back(next());
    fields.resize(kFieldCount);
    return fields;
  }

  char parameter_delimiter() const { return parameter_delimiter_; }
  char record_delimiter() const { return record_delimiter_; }
  bool miscounted() const { return miscounted_; }

  /// Whether the first two fields are not closed by the parameter delimiter.
  bool malformed() const { return malformed_; }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  /// One of the first two fields, and the delimiter behind it.
  char delimiter(char standard) {
    skip_blanks();
    char found = standard;
    if (text_.substr(at_, 2) == "1H" && at_ + 2 < text_.size()) {
      found = text_[at_ + 2];
      at_ += 3;
      skip_blanks();
    }
    const char closing = standard == ',' ? found : parameter_delimiter_;
    if (at_ < text_.size() && text_[at_] == closing) {
      ++at_;
    } else {
      ended_ = true;
    }
    return found;
  }

  bool is_delimiter(char c) const { return c == parameter_delimiter_ || c == record_delimiter_; }

  FieldText next() {
    skip_blanks();
    FieldText field;
    std::size_t begin = at_;
    if (const auto head = hollerith_head(text_, at_)) {
      field.is_string = true;
      begin = head->begin;
      if (trust_counts_ && begin + head->count <= text_.size()) {
        at_ = begin + head->count;
        field.text = text_.substr(begin, head->count);
        skip_blanks();
        if (at_ >= text_.size() || is_delimiter(text_[at_])) return close(std::move(field));
      }
      miscounted_ = true;
    }
    at_ = begin;
    while (at_ < text_.size() && !is_delimiter(text_[at_])) ++at_;
    field.text = trimmed(text_.substr(begin, at_ - begin));
    return close(std::move(field));
  }

  FieldText close(FieldText field) {
    ended_ = at_ >= text_.size() || text_[at_] == record_delimiter_;
    ++at_;
    return field;
  }

  std::string_view text_;
  bool trust_counts_;
  std::size_t at_ = 0;
  char parameter_delimiter_ = ',';
  char record_delimiter_ = ';';
  bool ended_ = false;
  bool miscounted_ = false;
  bool malformed_ = false;
};

/// A string whose count is wrong may swallow a delimiter and shift the fields behind it; then these do not
/// fit.
bool fits(const std::vector<FieldText>& fields) {
  const auto is_real_or_empty = [&](Field field) {
    return !fields[field].is_string && (fields[field].text.empty() || parse_real(fields[field].text));
  };
  const auto flag = parse_integer(fields[kUnitFlag].text);
  return is_real_or_empty(kModelScale) && is_real_or_empty(kUnitFlag) && is_real_or_empty(kResolution) &&
         is_real_or_empty(kMaxCoordinate) && (fields[kUnitFlag].text.empty() || flag) &&
         (fields[kUnitName].is_string || fields[kUnitName].text.empty());
}

}  // namespace

GlobalSection parse_global_section(const std::vector<std::string_view>& lines, const std::string& file,
                                   ToleranceLog& log) {
  const auto fail = [&](const std::string& problem) {
    throw ImportError({.file = file, .section = "global"}, problem, "export the file again");
  };
  if (lines.empty()) fail("the section is missing, and with it the unit of length");
  std::string text;
  text.reserve(lines.size() * lines.front().size());
  for (const std::string_view line : lines) text += line;

  FieldSplitter splitter(text, true);
  std::vector<FieldText> fields = splitter.split();
  if (splitter.malformed())
    fail("the section must start with its two delimiters, such as \",,\" or \"1H,,1H;,\"");
  bool miscounted = splitter.miscounted();
  if (!fits(fields)) {
    fields = FieldSplitter(text, false).split();
    miscounted = true;
  }
  if (!fits(fields)) fail("the model scale, unit or resolution (fields 13, 14, 15, 19, 20) is not a number");
  if (miscounted) log.note(Tolerance::kHollerithCount, "global", 1);

  GlobalSection global;
  global.parameter_delimiter = splitter.parameter_delimiter();
  global.record_delimiter = splitter.record_delimiter();
  // Characters that can be part of a number cannot part numbers.
  constexpr std::string_view kForbidden = "0123456789+-. DEHdeh";
  for (const char c : {global.parameter_delimiter, global.record_delimiter}) {
    if (kForbidden.find(c) != std::string_view::npos) fail(fmt::format("'{}' cannot be a delimiter", c));
  }
  if (global.parameter_delimiter == global.record_delimiter) fail("both delimiters are the same");

  global.product = fields[kProduct].text;
  global.system = fields[kSystem].text;
  global.preprocessor = fields[kPreprocessor].text;
  global.author = fields[kAuthor].text;
  global.organization = fields[kOrganization].text;
  global.unit_name = trimmed(fields[kUnitName].text);
  global.unit_flag = parse_integer(fields[kUnitFlag].text).value_or(0);
  global.resolution = std::max(0.0, parse_real(fields[kResolution].text).value_or(0.0));
  global.max_coordinate = std::max(0.0, parse_real(fields[kMaxCoordinate].text).value_or(0.0));
  global.model_scale = parse_real(fields[kModelScale].text).value_or(1.0);
  if (!(global.model_scale > 0.0)) {
    log.note(Tolerance::kModelScale, "global", 1, fields[kModelScale].text);
    global.model_scale = 1.0;
  }
  return global;
}

}  // namespace lamina::engine
