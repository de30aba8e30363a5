// An image file inside the stream of a terminal that decodes it: the protocols of kitty
// (https://sw.kovidgoyal.net/kitty/graphics-protocol/) and of iTerm2
// (https://iterm2.com/documentation-images.html).
#pragma once

#include <string>
#include <string_view>

#include "client/terminal.h"

namespace raytracer::client {

/// A PNG in as many cells as fit the columns and rows, which the terminal
/// scales it to if it is larger.
std::string kitty_image(std::string_view png, const TerminalSize& size);
std::string iterm_image(std::string_view png, const TerminalSize& size);

}  // namespace raytracer::client
