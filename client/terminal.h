// What the client needs to know about the terminal that it writes to.
#pragma once

namespace raytracer::client {

struct TerminalSize {
  int columns = 80;
  int rows = 24;
  int column_px = 10;
  int row_px = 20;
};

/// Of the terminal behind the file descriptor; the defaults for what it does not say.
TerminalSize terminal_size(int fd);

/// True if TERM does not say that the terminal takes nothing but text.
bool takes_control_sequences();

}  // namespace raytracer::client
