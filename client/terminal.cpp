#include "client/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace raytracer::client {
namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

TerminalSize terminal_size(int fd) {
  winsize size{};
  if (::ioctl(fd, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {};
  return {size.ws_col, size.ws_row};
}

bool takes_control_sequences() { return variable("TERM") != "dumb"; }

TerminalGraphics terminal_graphics() {
  if (!takes_control_sequences()) return TerminalGraphics::characters;
  const std::string_view type = variable("TERM");
  if (!variable("TMUX").empty() || type.starts_with("screen") || type.starts_with("tmux"))
    return TerminalGraphics::half_blocks;
  if (!variable("KITTY_WINDOW_ID").empty() || type == "xterm-kitty" || type == "xterm-ghostty")
    return TerminalGraphics::kitty;
  const std::string_view program = variable("TERM_PROGRAM");
  if (program == "iTerm.app" || program == "WezTerm" || variable("LC_TERMINAL") == "iTerm2")
    return TerminalGraphics::iterm;
  if (type.starts_with("foot") || type.starts_with("mlterm") || type.starts_with("contour"))
    return TerminalGraphics::sixel;
  return TerminalGraphics::half_blocks;
}

}  // namespace raytracer::client
