#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lamina::transport {

/// MeatPack, Marlin's packing of G-code for the wire (Cap:MEATPACK): the fifteen most frequent characters
/// take half a byte each, every other one half a byte and a byte of its own. The first character lies in the
/// low half. A control command, two bytes 0xFF and a code, is understood anywhere.
namespace meatpack {

inline constexpr char kSignal = '\xFF';
inline constexpr char kEnable = '\xFB';
inline constexpr char kDisable = '\xFA';
inline constexpr char kResetAll = '\xF9';
inline constexpr char kQuery = '\xF8';
inline constexpr char kNoSpaces = '\xF7';    ///< half byte 11 stands for E
inline constexpr char kWithSpaces = '\xF6';  ///< half byte 11 stands for a blank

/// The half byte that announces a character of its own.
inline constexpr unsigned kLiteral = 0xF;
/// The half byte of a line end.
inline constexpr unsigned kLineEnd = 0xC;

/// The characters of half bytes 0 to 14.
std::string_view alphabet(bool no_spaces);

/// The bytes of one control command.
std::string control(char code);

/// Everything that makes the decoder, whatever state noise has left it in, ready for what `pack` makes:
/// reset, the meaning of half byte 11 (the reset of Marlin 2.1 leaves it as it was), on.
std::string start(bool no_spaces);

/// `lines`, whole lines with their ends, packed. Every line begins with a byte of its own, so that one that
/// is lost does not shift the next. Two equal characters never share a byte: the checksum, an exclusive or,
/// would not notice if noise took that byte away. And N1, at a line's beginning, does not: the N, half a byte
/// of ones, is one bit from a G, and G1 would be run unchecked. A minus, half a byte of ones as well, is one
/// bit from X and G2, which have its sum; it and what follows it get a byte each. `wide`: pairs of
/// characters, counted over `lines`, both of which get a byte of their own (a line end at the first place
/// takes none). No byte of `lines` may be 0xFF.
std::string pack(std::string_view lines, bool no_spaces, const std::vector<bool>& wide = {});

/// How many bytes, with it, stand for the pair of characters that begins with `byte`.
std::size_t pair_bytes(char byte);
/// The pair of characters that begins with `byte` has a line end in it.
bool ends_line(char byte);

}  // namespace meatpack

}  // namespace lamina::transport
