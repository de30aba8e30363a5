#include "client/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace raytracer::client {

TerminalSize terminal_size(int fd) {
  TerminalSize size;
  winsize said{};
  if (::ioctl(fd, TIOCGWINSZ, &said) != 0 || said.ws_col == 0 || said.ws_row == 0) return size;
  size.columns = said.ws_col;
  size.rows = said.ws_row;
  if (said.ws_xpixel >= said.ws_col && said.ws_ypixel >= said.ws_row) {
    size.column_px = said.ws_xpixel / said.ws_col;
    size.row_px = said.ws_ypixel / said.ws_row;
  }
  return size;
}

bool takes_control_sequences() {
  const char* const type = std::getenv("TERM");
  return type == nullptr || std::string_view(type) != "dumb";
}

}  // namespace raytracer::client
