#include "tests/reference/grid/thin.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/reference/grid/grid_text.h"

namespace lamina::tests {
namespace {

std::size_t count(const GridText& rows) {
  std::size_t sum = 0;
  for (const std::string& row : rows)
    sum += static_cast<std::size_t>(std::count(row.begin(), row.end(), 'o'));
  return sum;
}

GridText thinned(const GridText& rows) {
  reference::LayerGrid grid = grid_from_text(rows);
  reference::thin_lines(grid);
  return text_of(grid);
}

}  // namespace

TEST_CASE("a line two cells wide becomes one cell wide", "[thin]") {
  const GridText line = thinned({"..........",  //
                                 ".oooooooo.",  //
                                 ".oooooooo.",  //
                                 ".........."});
  CHECK(count(line) >= 7);
  CHECK(count(line) <= 8);
  for (std::size_t x = 2; x <= 7; ++x) CHECK((line[1][x] == 'o') != (line[2][x] == 'o'));
}

TEST_CASE("a line one cell wide keeps all its cells", "[thin]") {
  for (const GridText& line :
       {GridText{"....", ".oo.", "...."}, GridText{".....", ".ooo.", "....."},
        GridText{".....", ".o...", "..o..", "...o.", "....."}, GridText{"...", ".o.", "..."}}) {
    CHECK(thinned(line) == line);
  }
}

TEST_CASE("what is thinned is counted", "[thin]") {
  const GridText block{".....",  //
                       ".ooo.",  //
                       ".ooo.",  //
                       "....."};
  reference::LayerGrid grid = grid_from_text(block);
  const std::size_t removed = reference::thin_lines(grid);
  CHECK(count(text_of(grid)) + removed == count(block));
  CHECK(removed > 0);
}

}  // namespace lamina::tests
