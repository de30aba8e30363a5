// A picture in a terminal: as an image where it takes one (kitty, iTerm2, sixels), else in blocks
// of as many colours as it has, and in characters where it takes nothing but text.
#pragma once

#include <string>
#include <string_view>

#include "client/terminal.h"

namespace raytracer::client {

/// The picture of a P6 with 8 bits a channel, in its aspect; it fits the columns and rows, and
/// takes no more of them than it has pixels. The environment (TERM, TERM_PROGRAM, ...) says what
/// the terminal is. Throws ServerError if the bytes are no P6, or not whole.
std::string terminal_picture(std::string_view image, const TerminalSize& size);

}  // namespace raytracer::client
