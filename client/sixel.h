// A picture as sixels: bands of six rows, each colour's pixels of a band in one pass (VT340
// Programmer Reference Manual, chapter 14).
#pragma once

#include <string>

#include "client/terminal_picture.h"

namespace raytracer::client {

/// In six levels of red, green and blue, ordered dithering between them. Fits the columns and rows
/// where a cell has 10 x 20 pixels, and is never larger than the picture.
std::string sixels(const Pixmap& picture, const TerminalSize& size);

}  // namespace raytracer::client
