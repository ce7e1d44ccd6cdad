#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lamina::transport {

/// `command`, without blanks, with zeros put in front of some of its numbers, so that equal characters seldom
/// fall into one byte when it is packed two to a byte: each such pair has to be kept apart, which takes a
/// byte (see meatpack::pack), where a zero takes half of one. `offset` characters stand before it on the
/// line. The values stay.
std::string packable_form(std::string_view command, std::size_t offset);

}  // namespace lamina::transport
