#include "transport/protocol/packable_form.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "transport/protocol/command_class.h"

namespace lamina::transport {

namespace {

/// In half bytes.
constexpr int kPairCost = 2;
/// Of a minus as the second: more than there is to save elsewhere.
constexpr int kMinusCost = 100;
constexpr int kZeroCost = 1;
constexpr int kNever = std::numeric_limits<int>::max() / 2;

bool is_letter(char c) {
  return c >= 'A' && c <= 'Z';
}

/// A zero in front of its number could make it another command: G.1 is none, G0.1 is one.
bool names_command(char letter) {
  return letter == 'G' || letter == 'M' || letter == 'T';
}

/// Digits with a point among them or none.
bool is_number(std::string_view text) {
  const auto points = std::count(text.begin(), text.end(), '.');
  const auto digits = std::count_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits > 0 && points <= 1 && static_cast<std::size_t>(digits + points) == text.size();
}

/// The words of a command, each as it is and with a zero in front of its number.
struct Word {
  std::array<std::string, 2> forms;
  bool may_pad = false;
  bool plain = false;  ///< a letter, and a number or nothing
};

std::vector<Word> words_of(std::string_view command) {
  std::vector<Word> words;
  while (!command.empty()) {
    std::size_t end = 1;
    while (end < command.size() && !is_letter(command[end])) ++end;
    Word word;
    word.forms[0] = word.forms[1] = std::string(command.substr(0, end));
    // The command word stays, behind a line number, too: G01 and M0104 are nobody's habit.
    const std::size_t number = end > 1 && command[1] == '-' ? 2 : 1;
    const bool has_number = is_number(command.substr(number, end - std::min(end, number)));
    word.plain = is_letter(command[0]) && (end == 1 || has_number);
    word.may_pad = !words.empty() && has_number && !names_command(command[0]);
    if (word.may_pad) word.forms[1].insert(number, 1, '0');
    words.push_back(std::move(word));
    command.remove_prefix(end);
  }
  return words;
}

/// What the pairs of characters in `text` cost that cannot share a byte well; `place` is that of its first
/// character on the line, `before` the character in front of it.
int pair_costs(std::string_view text, std::size_t place, char before) {
  int costs = 0;
  for (const char c : text) {
    if (place % 2 == 1) costs += c == '-' ? kMinusCost : c == before ? kPairCost : 0;
    before = c;
    ++place;
  }
  return costs;
}

/// The cheapest way to write the words so far, for an even and for an odd place of what follows.
struct Best {
  int cost = kNever;
  std::string text;
};

}  // namespace

std::string packable_form(std::string_view command, std::size_t offset) {
  if (takes_text(command) || command.find(' ') != std::string_view::npos) return std::string(command);
  std::array<Best, 2> best;
  best[offset % 2].cost = 0;
  const std::vector<Word> words = words_of(command);
  // What is no list of letters and numbers stays.
  if (!std::all_of(words.begin(), words.end(), [](const Word& word) { return word.plain; }))
    return std::string(command);
  for (const Word& word : words) {
    std::array<Best, 2> next;
    for (std::size_t parity = 0; parity < 2; ++parity) {
      if (best[parity].cost >= kNever) continue;
      const char before = best[parity].text.empty() ? '\0' : best[parity].text.back();
      for (std::size_t padded = 0; padded < (word.may_pad ? 2U : 1U); ++padded) {
        const std::string& form = word.forms[padded];
        const int cost =
            best[parity].cost + pair_costs(form, parity, before) + kZeroCost * static_cast<int>(padded);
        Best& candidate = next[(parity + form.size()) % 2];
        if (cost < candidate.cost) candidate = {cost, best[parity].text + form};
      }
    }
    best = std::move(next);
  }
  return best[0].cost <= best[1].cost ? best[0].text : best[1].text;
}

}  // namespace lamina::transport
