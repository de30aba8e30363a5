#include "client/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace raytracer::client {

TerminalSize terminal_size(int fd) {
  winsize size{};
  if (::ioctl(fd, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {};
  return {size.ws_col, size.ws_row};
}

bool takes_control_sequences() {
  const char* type = std::getenv("TERM");
  return std::string_view(type == nullptr ? "" : type) != "dumb";
}

}  // namespace raytracer::client
