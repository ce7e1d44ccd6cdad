#include "transport/protocol/packed_line.h"

#include <vector>

#include "transport/protocol/command_class.h"
#include "transport/protocol/line_acceptance.h"
#include "transport/protocol/line_assembler.h"
#include "transport/protocol/meatpack.h"
#include "transport/protocol/meatpack_decoder.h"

namespace lamina::transport {

namespace {

constexpr int kBitsOfByte = 8;

/// More weak places than a line has.
constexpr int kMostAttempts = 8;

/// The firmware, reading a line and the one behind it.
class Reading {
 public:
  Reading(std::string_view line, LineNumber number, bool no_spaces)
      : line_(line.substr(0, line.rfind('*'))),
        number_(number),
        assembler_(kMaxLineBytes),
        acceptance_(true) {
    acceptance_.set_last_line(number - 1);
    for (const char byte : meatpack::start(no_spaces)) decoder_.push(byte);
  }

  /// False if they make it run something else than the line.
  bool take(std::string_view bytes) {
    for (const char byte : bytes) {
      for (const char character : decoder_.push(byte).text) {
        const auto read = assembler_.push(character);
        if (read && !harmless(*read)) return false;
      }
    }
    return true;
  }

 private:
  bool harmless(std::string_view read) {
    if (!read.starts_with('N')) return classify(read) != CommandClass::kMotion;
    const bool runs = acceptance_.judge(read) == Verdict::kAccepted;
    return !runs || acceptance_.last_line() == number_ + 1 || read.substr(0, read.rfind('*')) == line_;
  }

  std::string_view line_;
  LineNumber number_;
  MeatPackDecoder decoder_;
  LineAssembler assembler_;
  LineAcceptance acceptance_;
};

/// Two characters, and no line end among them.
bool is_plain_pair(char byte) {
  return meatpack::pair_bytes(byte) == 1 && !meatpack::ends_line(byte);
}

/// A character that stands for itself in a line. Backspaces, comments and the like do not.
bool is_ordinary(char character) {
  return (character < '\0' || character >= ' ') && character != ';' && character != '\\' &&
         character != meatpack::kSignal;
}

/// The first pair of characters in `packed` where damage would go unnoticed.
std::optional<std::size_t> weak_pair(std::string_view packed, std::string_view line, LineNumber number,
                                     bool no_spaces) {
  // Where the end is lost the next line is joined to this one. It brings its own sum along, so any will do.
  const std::string next = meatpack::pack(frame_line(number + 1, "M105", {false, true}), no_spaces);
  Reading before(line, number, no_spaces);
  std::size_t pair = 0;
  std::size_t pair_end = meatpack::pair_bytes(packed[0]);
  bool literal = false;
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const char byte = packed[i];
    const std::string rest = std::string(packed.substr(i + 1)) + next;
    const auto noticed = [&](std::string_view damaged) {
      Reading reading = before;
      return reading.take(damaged) && reading.take(rest);
    };
    // Two different characters less, or one in another's place, change the sum by themselves.
    const bool plain_pair = !literal && is_plain_pair(byte);
    if (!plain_pair && !noticed({})) return pair;
    for (int bit = 0; bit < kBitsOfByte; ++bit) {
      const char flipped = static_cast<char>(byte ^ (1 << bit));
      const bool changes_sum = literal ? is_ordinary(flipped) : plain_pair && is_plain_pair(flipped);
      if (!changes_sum && !noticed({&flipped, 1})) return pair;
    }
    before.take({&byte, 1});
    literal = i + 1 < pair_end;
    if (literal || i + 1 == packed.size()) continue;
    ++pair;
    pair_end += meatpack::pair_bytes(packed[i + 1]);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> packed_line(std::string_view line, LineNumber number, bool no_spaces) {
  std::string text(line);
  std::vector<bool> wide(text.size() / 2 + 2, false);
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    std::string packed = meatpack::pack(text, no_spaces, wide);
    const auto weak = weak_pair(packed, line, number, no_spaces);
    if (!weak) return packed;
    const bool has_end = *weak == (text.size() - 1) / 2;
    if (has_end && text.size() == line.size()) {
      // The sum's last digit and the end, lost together. Marlin does not look at what is behind the digits.
      text.insert(text.size() - 1, 1, '.');
    } else {
      // What follows a lost byte may be to blame as well.
      wide[wide[*weak] ? *weak + 1 : *weak] = true;
    }
  }
  return std::nullopt;
}

}  // namespace lamina::transport
