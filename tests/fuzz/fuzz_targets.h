#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace lamina::fuzz {

/// Something that must hold for every input does not.
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline void require(bool holds, const char* what) {
  if (!holds) throw BrokenPromise(what);
}

// Each takes any bytes at all and throws BrokenPromise where something that is promised does not hold.

/// The host's reading of the printer's words: lines from bytes, cut anywhere alike, and what each says.
void replies(std::string_view input);

/// The emulated printer, fed with any bytes in any pieces at any time.
void printer_lines(std::string_view input);

/// MeatPack, there and back.
void meatpack_round_trip(std::string_view input);

/// The unpacker, given whatever.
void meatpack_decoder(std::string_view input);

/// The protocol engine: the input is a script of calls, moments and the printer's bytes, from any state.
void protocol_engine(std::string_view input);

struct Target {
  const char* name;
  void (*run)(std::string_view);
};

/// All of them, by the names of their corpora.
inline constexpr std::array kTargets{Target{"replies", replies}, Target{"printer_lines", printer_lines},
                                     Target{"meatpack_round_trip", meatpack_round_trip},
                                     Target{"meatpack_decoder", meatpack_decoder},
                                     Target{"protocol_engine", protocol_engine}};

}  // namespace lamina::fuzz
