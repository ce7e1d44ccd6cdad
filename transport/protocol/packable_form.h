#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lamina::transport {

/// `command`, without blanks, with zeros put in front of some of its numbers, so that equal characters seldom
/// fall into one byte when it is packed two to a byte: each such pair has to be kept apart, which takes a
/// byte (see meatpack::pack), where a zero takes half of one. And so that a minus seldom comes second: turned
/// over by one bit, the half byte of ones before it makes X of it and G2 of the minus, and X, G and 2 have
/// its sum. `offset` characters stand before the command on the line. The values stay.
std::string packable_form(std::string_view command, std::size_t offset);

}  // namespace lamina::transport
