#include "transport/protocol/meatpack_decoder.h"

#include <utility>

#include "transport/protocol/meatpack.h"

namespace lamina::transport {

MeatPackDecoder::Decoded MeatPackDecoder::push(char byte) {
  if (byte == meatpack::kSignal) {
    if (signal_seen_) command_next_ = true;
    signal_seen_ = !signal_seen_;
    return {};
  }
  if (command_next_) {
    command_next_ = false;
    obey(byte);
    return {{}, state()};
  }
  Decoded decoded;
  // One alone was data after all: two literals.
  if (std::exchange(signal_seen_, false)) decoded.text = unpack(meatpack::kSignal);
  decoded.text += unpack(byte);
  return decoded;
}

void MeatPackDecoder::obey(char code) {
  switch (code) {
    case meatpack::kEnable:
      enabled_ = true;
      break;
    case meatpack::kDisable:
      enabled_ = false;
      break;
    case meatpack::kResetAll: {
      const bool packs_e = packs_e_;
      restart();
      packs_e_ = packs_e;
      break;
    }
    case meatpack::kNoSpaces:
    case meatpack::kWithSpaces:
      no_spaces_ = packs_e_ = code == meatpack::kNoSpaces;
      break;
    default:
      break;
  }
}

std::string MeatPackDecoder::state() const {
  return std::string("[MP] PV01 ") + (enabled_ ? "ON " : "OFF ") + (no_spaces_ ? "NSP\n" : "ESP\n");
}

std::string MeatPackDecoder::unpack(char byte) {
  if (!enabled_) return {byte};
  if (literals_due_ > 0) {
    --literals_due_;
    std::string text{byte};
    if (const char second = std::exchange(second_after_, '\0')) text += second;
    return text;
  }
  const auto value = static_cast<unsigned char>(byte);
  const unsigned first = value & 0xFU;
  const unsigned second = value >> 4U;
  const std::string_view alphabet = meatpack::alphabet(packs_e_);
  if (first == meatpack::kLiteral) {
    literals_due_ = second == meatpack::kLiteral ? 2 : 1;
    if (second != meatpack::kLiteral) second_after_ = alphabet[second];
    return {};
  }
  std::string text{alphabet[first]};
  if (first == meatpack::kLineEnd) return text;
  if (second == meatpack::kLiteral) {
    literals_due_ = 1;
  } else {
    text += alphabet[second];
  }
  return text;
}

}  // namespace lamina::transport
