#include "gcode/marlin/gcode_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "gcode/marlin/number_text.h"

namespace lamina::gcode {
namespace {

/// M-codes whose argument is a text or a file name.
constexpr std::array<int, 10> kTextCommands{16, 23, 28, 30, 32, 33, 117, 118, 808, 928};

constexpr double kMaxCommandNumber = 99999.0;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool is_letter(char c) {
  return upper(c) >= 'A' && upper(c) <= 'Z';
}

bool takes_text(const Command& command) {
  return command.letter == 'M' && std::ranges::find(kTextCommands, command.number) != kTextCommands.end();
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

class LineReader {
 public:
  LineReader(std::string_view text, std::size_t number) : text_(text), number_(number) {}

  GcodeLine read() {
    GcodeLine line;
    skip_blanks();
    if (!at_end() && text_[at_] != ';') line.command = read_command();
    if (line.command && takes_text(*line.command)) {
      const std::size_t end = std::min(text_.find(';', at_), text_.size());
      line.argument = trimmed(text_.substr(at_, end - at_));
      at_ = end;
    } else if (line.command) {
      read_words(line.words);
    }
    if (!at_end()) line.comment = std::string(comment_text());
    return line;
  }

 private:
  bool at_end() const { return at_ >= text_.size(); }

  void skip_blanks() {
    while (!at_end() && is_blank(text_[at_])) ++at_;
  }

  std::string_view comment_text() const {
    std::string_view comment = text_.substr(at_ + 1);
    if (!comment.empty() && comment.back() == '\r') comment.remove_suffix(1);
    return comment;
  }

  Command read_command() {
    Command command;
    command.letter = upper(text_[at_]);
    if (command.letter != 'G' && command.letter != 'M' && command.letter != 'T') {
      fail("expected a G, M or T command");
    }
    ++at_;
    command.number = read_code();
    if (!at_end() && text_[at_] == '.') {
      ++at_;
      command.subcode = read_code();
    }
    return command;
  }

  int read_code() {
    const std::size_t begin = at_;
    int code = 0;
    while (!at_end() && text_[at_] >= '0' && text_[at_] <= '9') {
      code = code * 10 + (text_[at_] - '0');
      if (code > kMaxCommandNumber) fail("command number out of range");
      ++at_;
    }
    if (at_ == begin) fail("expected the command's number");
    return code;
  }

  void read_words(std::vector<Word>& words) {
    for (skip_blanks(); !at_end() && text_[at_] != ';'; skip_blanks()) {
      if (text_[at_] == '*') fail("checksums belong to the wire, not to a file");
      if (!is_letter(text_[at_])) fail("expected a word: a letter and a number");
      Word word{upper(text_[at_]), std::nullopt};
      ++at_;
      if (const auto number = read_number(text_.substr(at_))) {
        word.value = number->value;
        at_ += number->size;
      }
      words.push_back(word);
    }
  }

  [[noreturn]] void fail(const std::string& problem) const { throw GcodeError(number_, at_ + 1, problem); }

  std::string_view text_;
  std::size_t number_;
  std::size_t at_ = 0;
};

}  // namespace

bool GcodeLine::is(char letter, int number) const {
  return command && command->letter == letter && command->number == number && !command->subcode;
}

std::optional<double> GcodeLine::value(char letter) const {
  const auto word = std::ranges::find(words, letter, &Word::letter);
  return word == words.end() ? std::nullopt : word->value;
}

std::string GcodeLine::text() const {
  std::string text;
  if (command) {
    text.append(1, command->letter).append(std::to_string(command->number));
    if (command->subcode) text.append(1, '.').append(std::to_string(*command->subcode));
    for (const Word& word : words) {
      text += ' ';
      text += word.letter;
      if (word.value) text += exact_text(*word.value);
    }
    if (!argument.empty()) text.append(1, ' ').append(argument);
    if (comment) text += ' ';
  }
  if (comment) text.append(1, ';').append(*comment);
  return text;
}

GcodeError::GcodeError(std::size_t line_number, std::size_t column_number, const std::string& problem)
    : std::runtime_error((line_number > 0 ? "line " + std::to_string(line_number) + ", " : std::string()) +
                         "column " + std::to_string(column_number) + ": " + problem),
      line(line_number),
      column(column_number) {}

GcodeLine parse_line(std::string_view text, std::size_t number) {
  return LineReader(text, number).read();
}

}  // namespace lamina::gcode
