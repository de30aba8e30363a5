// What the client needs to know about the terminal that it writes to.
#pragma once

namespace raytracer::client {

struct TerminalSize {
  int columns = 80;
  int rows = 24;
};

/// Of the terminal behind the file descriptor; 80 x 24 if it does not say.
TerminalSize terminal_size(int fd);

/// True if TERM does not say that the terminal takes nothing but text.
bool takes_control_sequences();

/// How a terminal can be made to show a picture, best first.
enum class TerminalGraphics { kitty, iterm, sixel, half_blocks, characters };

/// What the terminal says of itself in TERM, TERM_PROGRAM, LC_TERMINAL and KITTY_WINDOW_ID. Inside
/// tmux or screen, which let no images through, half blocks.
TerminalGraphics terminal_graphics();

}  // namespace raytracer::client
