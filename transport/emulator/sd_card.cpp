#include "transport/emulator/sd_card.h"

#include <algorithm>
#include <utility>

namespace lamina::transport {

bool SdCard::select(std::string_view name) {
  const std::string wanted = dos_name(name);
  abort();
  if (!files_.contains(wanted)) return false;
  selected_ = wanted;
  return true;
}

std::size_t SdCard::size() const {
  return selected_ ? files_.at(*selected_).size() : 0;
}

void SdCard::abort() {
  printing_ = false;
  position_ = 0;
  selected_.reset();
}

std::optional<std::string> SdCard::next_line() {
  if (!printing_) return std::nullopt;
  const std::string& content = files_.at(*selected_);
  if (position_ >= content.size()) {
    abort();
    return std::nullopt;
  }
  const std::size_t end = std::min(content.find('\n', position_), content.size());
  std::string line = content.substr(position_, end - position_);
  position_ = std::min(end + 1, content.size());
  return line;
}

void SdCard::begin_file(std::string_view name) {
  written_ = dos_name(name);
  content_.clear();
}

void SdCard::write_line(std::string_view line) {
  content_ += line;
  content_ += '\n';
}

void SdCard::close_file() {
  if (written_) files_[*written_] = std::exchange(content_, {});
  written_.reset();
}

bool SdCard::remove(std::string_view name) {
  const std::string unwanted = dos_name(name);
  if (selected_ == unwanted) abort();
  return files_.erase(unwanted) > 0;
}

void SdCard::restart() {
  abort();
  written_.reset();
  content_.clear();
}

std::string SdCard::dos_name(std::string_view name) {
  while (name.starts_with('/') || name.starts_with(' ')) name.remove_prefix(1);
  name = name.substr(0, name.find_first_of(" #"));
  std::string result(name);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

}  // namespace lamina::transport
