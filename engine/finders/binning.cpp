#include "engine/finders/binning.h"

#include <algorithm>

namespace raytracer {

Parts parts_in(const CellRectangle& cells, int column, int row) {
  const int x_begin = std::max(cells.x_begin - parts_across * column, 0);
  const int x_end = std::min(cells.x_end - parts_across * column, parts_across);
  const int y_begin = std::max(cells.y_begin - parts_across * row, 0);
  const int y_end = std::min(cells.y_end - parts_across * row, parts_across);
  const unsigned in_row = ((1U << x_end) - 1U) & ~((1U << x_begin) - 1U);
  unsigned parts = 0;
  for (int y = y_begin; y < y_end; ++y) parts |= in_row << (parts_across * y);
  return static_cast<Parts>(parts);
}

}  // namespace raytracer
