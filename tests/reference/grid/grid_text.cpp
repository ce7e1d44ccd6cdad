#include "tests/reference/grid/grid_text.h"

#include <stdexcept>

namespace lamina::tests {
namespace {

using reference::CellState;
using reference::LayerGrid;

/// In the order of CellState.
const std::string characters = ".v^#,oipr";

}  // namespace

LayerGrid grid_from_text(const GridText& rows) {
  const auto columns = static_cast<std::ptrdiff_t>(rows.empty() ? 0 : rows.front().size());
  const auto count = static_cast<std::ptrdiff_t>(rows.size());
  LayerGrid grid(engine::Vector2::Zero(), 1.0, columns, count);
  for (std::ptrdiff_t row = 0; row < count; ++row) {
    const std::string& text = rows[static_cast<std::size_t>(row)];
    if (static_cast<std::ptrdiff_t>(text.size()) != columns)
      throw std::invalid_argument("rows differ in length");
    for (std::ptrdiff_t x = 0; x < columns; ++x) {
      const std::size_t state = characters.find(text[static_cast<std::size_t>(x)]);
      if (state == std::string::npos) throw std::invalid_argument("no such cell: " + text);
      grid.set({x, count - 1 - row}, static_cast<CellState>(state));
    }
  }
  return grid;
}

GridText text_of(const LayerGrid& grid) {
  GridText rows;
  for (std::ptrdiff_t y = grid.rows() - 1; y >= 0; --y) {
    rows.emplace_back();
    for (std::ptrdiff_t x = 0; x < grid.columns(); ++x) {
      rows.back() += characters[static_cast<std::size_t>(grid.state({x, y}))];
    }
  }
  return rows;
}

}  // namespace lamina::tests
