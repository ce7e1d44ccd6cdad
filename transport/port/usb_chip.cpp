#include "transport/port/usb_chip.h"

#include <algorithm>
#include <array>

namespace lamina::transport {

namespace {

constexpr std::array kChips{
    UsbChip{0x1a86, 0x7523, "CH340", "ch341", true},
    UsbChip{0x1a86, 0x5523, "CH341", "ch341", false},
    UsbChip{0x1a86, 0x7522, "CH340K", "ch341", false},
    UsbChip{0x1a86, 0x55d4, "CH9102", "cdc_acm", false},
    UsbChip{0x0403, 0x6001, "FT232R", "ftdi_sio", true},
    UsbChip{0x0403, 0x6015, "FT231X", "ftdi_sio", false},
    UsbChip{0x10c4, 0xea60, "CP210x", "cp210x", true},
    UsbChip{0x067b, 0x2303, "PL2303", "pl2303", false},
    UsbChip{0x2341, kAnyProduct, "Arduino", "cdc_acm", false},
    UsbChip{0x2a03, kAnyProduct, "Arduino", "cdc_acm", false},
    UsbChip{0x2c99, kAnyProduct, "Prusa", "cdc_acm", false},
    UsbChip{0x27b1, kAnyProduct, "RAMBo", "cdc_acm", false},
    UsbChip{0x1d50, 0x6029, "Marlin USB", "cdc_acm", false},
    UsbChip{0x0483, 0x5740, "STM32", "cdc_acm", false},
    UsbChip{0x16c0, 0x0483, "Teensy", "cdc_acm", false},
};

}  // namespace

std::span<const UsbChip> usb_chips() {
  return kChips;
}

const UsbChip* find_usb_chip(int vendor, int product) {
  const auto* const found = std::find_if(kChips.begin(), kChips.end(), [&](const UsbChip& chip) {
    return chip.vendor == vendor && (chip.product == product || chip.product == kAnyProduct);
  });
  return found == kChips.end() ? nullptr : found;
}

}  // namespace lamina::transport
