#include "transport/session/source_reader.h"

#include <utility>

#include <fmt/format.h>

namespace lamina::transport {

namespace {

/// FNV-1a, 64 bits, over the line and its end.
std::uint64_t hash_on(std::uint64_t hash, const std::string& line) {
  constexpr std::uint64_t kPrime = 1099511628211U;
  for (const char c : line) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  return (hash ^ static_cast<unsigned char>('\n')) * kPrime;
}

}  // namespace

SourceReader::SourceReader(LineSource source) : source_(std::move(source)) {}

std::optional<SourceCommand> SourceReader::next() {
  while (ready_.empty()) {
    const std::optional<std::string> line = take_line();
    if (!line) return std::nullopt;
    std::vector<std::string> commands = filter_.push(*line);
    if (commands.empty()) continue;
    const auto state = std::make_shared<const FilterState>(filter_.state());
    for (std::size_t part = 0; part < commands.size(); ++part) {
      const bool last = part + 1 == commands.size();
      ready_.push_back({std::move(commands[part]),
                        {position_.lines, static_cast<int>(part), last, position_, last ? state : nullptr}});
    }
  }
  SourceCommand command = std::move(ready_.front());
  ready_.pop_front();
  return command;
}

void SourceReader::skip_to(const SourcePosition& position, FilterState state, int parts) {
  while (position_.lines < position.lines) {
    if (!take_line()) break;
  }
  if (position_ != position) {
    throw SourceChanged(fmt::format(
        "it is not what was being printed: the first {} lines differ; print the same file with the same "
        "settings",
        position.lines));
  }
  filter_.restore(std::move(state));
  for (int part = 0; part < parts; ++part) next();
}

void SourceReader::end() {
  source_ = [] { return std::nullopt; };
  ready_.clear();
}

std::optional<std::string> SourceReader::take_line() {
  std::optional<std::string> line = source_();
  if (!line) return std::nullopt;
  ++position_.lines;
  position_.bytes += static_cast<std::int64_t>(line->size()) + 1;
  position_.hash = hash_on(position_.hash, *line);
  progress_.read(*line);
  return line;
}

}  // namespace lamina::transport
