#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace lamina::tests {

/// What a serial receiver at `receive_baud` makes of `bytes` sent without a pause at `send_baud`: the wire as
/// bits over time (start bit 0, eight data bits from the lowest, stop bit 1), sampled in the middle of each
/// bit counted from the falling edge of the start bit. A byte without its stop bit comes out as 00, as
/// terminals deliver it.
inline std::string through_uart(std::string_view bytes, int send_baud, int receive_baud) {
  constexpr int kBitsPerByte = 10;
  const auto bit_count = static_cast<long>(bytes.size()) * kBitsPerByte;
  const auto level = [&](double sent_bits) {
    const auto bit = static_cast<long>(std::floor(sent_bits));
    if (bit < 0 || bit >= bit_count) return true;  // idle
    const auto byte = static_cast<unsigned char>(bytes[static_cast<std::size_t>(bit / kBitsPerByte)]);
    const long place = bit % kBitsPerByte;
    return place == 0 ? false : place == kBitsPerByte - 1 ? true : ((byte >> (place - 1)) & 1) != 0;
  };
  // Everything in sent bits; one received bit is so many of them.
  const double received_bit = static_cast<double>(send_baud) / receive_baud;
  const double step = std::min(received_bit, 1.0) / 16;
  std::string received;
  for (double at = 0; at < static_cast<double>(bit_count); at += step) {
    if (level(at)) continue;
    int value = 0;
    for (int bit = 0; bit < 8; ++bit) value |= level(at + (bit + 1.5) * received_bit) ? 1 << bit : 0;
    const bool framed = level(at + 9.5 * received_bit);
    received += framed ? static_cast<char>(value) : '\0';
    at += 9.5 * received_bit;
    // After a broken frame the line must rise before the next start bit.
    while (!framed && at < static_cast<double>(bit_count) && !level(at)) at += step;
  }
  return received;
}

}  // namespace lamina::tests
