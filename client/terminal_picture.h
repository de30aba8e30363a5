// A picture in the cells of a terminal. With colours every cell is an upper half block with the
// colour of one pixel, on a background with the colour of the pixel below, so that pixels are
// nearly square; without, a character as light as two pixels.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "client/terminal.h"

namespace raytracer::client {

/// Rows of red, green and blue bytes, row 0 on top.
struct Pixmap {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;
};

/// Reads a P6 with 8 bits a channel. Throws ServerError if it is none, or not whole.
Pixmap read_ppm(std::string_view bytes);

/// The mean of the pixels (of parts of them, at the edges) that each of width x height covers.
/// Neither is more than the picture's own.
Pixmap shrink(const Pixmap& picture, int width, int height);

/// Shrunk to fit the columns and rows, of so many pixels each; never larger than the picture.
Pixmap fitted(const Pixmap& picture, const TerminalSize& size, double column_px, double row_px);

/// Lines of 24-bit coloured half blocks that fit the columns and rows, in the picture's aspect and
/// never larger than it is.
std::string half_blocks(const Pixmap& picture, const TerminalSize& size);

/// The same in characters from ' ' (black) to '@' (white), without control sequences.
std::string characters(const Pixmap& picture, const TerminalSize& size);

}  // namespace raytracer::client
