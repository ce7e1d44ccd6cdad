#pragma once

#include <span>
#include <string_view>

namespace lamina::transport {

/// A USB device behind which printers are found: a serial adapter on the board, or the board itself.
struct UsbChip {
  int vendor = 0;
  int product = 0;  ///< kAnyProduct: everything that this vendor makes
  std::string_view name;
  std::string_view module;        ///< the kernel module that serves it
  bool braille_displays = false;  ///< braille displays have the same chip, so brltty may take it
};

inline constexpr int kAnyProduct = -1;

/// All that are known; the same as in the udev rules that are installed.
std::span<const UsbChip> usb_chips();

/// The chip with these ids, or null.
const UsbChip* find_usb_chip(int vendor, int product);

}  // namespace lamina::transport
