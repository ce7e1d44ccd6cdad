#include "transport/session/card_protocol.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace lamina::transport {

namespace {

constexpr std::size_t kNameLetters = 8;

std::optional<std::int64_t> number_in(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string_view take_word(std::string_view& text) {
  const std::size_t blank = text.find(' ');
  const std::string_view word = text.substr(0, blank);
  text.remove_prefix(blank == std::string_view::npos ? text.size() : blank + 1);
  return word;
}

CardFile parse_file(std::string_view line) {
  CardFile file;
  file.name = take_word(line);
  file.size = number_in(take_word(line)).value_or(-1);
  if (line.starts_with("0x")) take_word(line);  // the time of its last change
  file.long_name = line;
  return file;
}

}  // namespace

std::optional<std::vector<CardFile>> card_files(const CommandAnswer& answer) {
  const auto begin = std::find(answer.text.begin(), answer.text.end(), "Begin file list");
  const auto end = std::find(begin, answer.text.end(), "End file list");
  if (begin == answer.text.end() || end == answer.text.end()) return std::nullopt;
  std::vector<CardFile> files;
  std::transform(begin + 1, end, std::back_inserter(files), parse_file);
  return files;
}

std::optional<CardProgress> card_progress(const CommandAnswer& answer) {
  constexpr std::string_view kProgress = "SD printing byte ";
  for (const std::string_view line : answer.text) {
    if (!line.starts_with(kProgress)) continue;
    const std::string_view numbers = line.substr(kProgress.size());
    const std::size_t slash = numbers.find('/');
    if (slash == std::string_view::npos) continue;
    const auto position = number_in(numbers.substr(0, slash));
    const auto size = number_in(numbers.substr(slash + 1));
    if (position && size) return CardProgress{*position, *size};
  }
  return std::nullopt;
}

std::optional<std::string> card_complaint(const CommandAnswer& answer) {
  constexpr std::array<std::string_view, 7> kComplaints{"open failed",    "Deletion failed", "No media",
                                                        "SD init fail",   "No SD card",      "error writing",
                                                        "Unknown command"};
  for (const std::string& line : answer.text) {
    for (const std::string_view complaint : kComplaints) {
      if (line.find(complaint) != std::string::npos) return line;
    }
  }
  return std::nullopt;
}

std::string card_name(const std::string& file_name) {
  const std::size_t slash = file_name.rfind('/');
  std::string_view stem = file_name;
  if (slash != std::string::npos) stem.remove_prefix(slash + 1);
  stem = stem.substr(0, stem.rfind('.'));
  std::string name;
  for (const char c : stem) {
    const bool lower = c >= 'a' && c <= 'z';
    const bool plain = lower || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (plain && name.size() < kNameLetters) name += lower ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return (name.empty() ? "PART" : name) + ".GCO";
}

}  // namespace lamina::transport
