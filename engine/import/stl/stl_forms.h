#pragma once

#include <string>
#include <string_view>

#include "engine/import/breach_log.h"
#include "engine/model.h"

/// The two forms of STL, each in its own file. Both throw ImportError, naming `file`.
namespace lamina::engine {

inline constexpr std::size_t kBinaryStlHeader = 84;  ///< bytes before the first facet
inline constexpr std::size_t kBinaryStlFacet = 50;   ///< bytes of a facet

/// Number of facets that the header of a binary file states; `bytes` are a header at least.
std::uint32_t binary_stl_count(std::string_view bytes);

TriangleMesh read_binary_stl(std::string_view bytes, const std::string& file, BreachLog& log);
TriangleMesh read_text_stl(std::string_view bytes, const std::string& file, BreachLog& log);

}  // namespace lamina::engine
