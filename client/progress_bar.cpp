#include "client/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "client/terminal.h"

namespace raytracer::client {
namespace {

/// "rendering [#####-----]  50 %  1.2 s", at most `columns` wide; `fraction` is 0 to 1.
std::string progress_line(const std::string& what, double fraction, double elapsed_s, int columns) {
  const double done = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0;
  // Rounded down: 100 % is said when it is true.
  const std::string numbers =
      fmt::format("{:3d} %  {:.1f} s", static_cast<int>(100 * done), elapsed_s);
  const int room = columns - static_cast<int>(what.size() + numbers.size()) - 5;
  if (room < 3) return numbers.substr(0, static_cast<std::size_t>(std::max(columns, 0)));
  const auto width = static_cast<std::size_t>(std::min(room, 40));
  const auto filled = static_cast<std::size_t>(static_cast<double>(width) * done);
  return fmt::format("{} [{}{}] {}", what, std::string(filled, '#'),
                     std::string(width - filled, '-'), numbers);
}

}  // namespace

ProgressBar::ProgressBar()
    : on_terminal_(::isatty(STDERR_FILENO) == 1 && takes_control_sequences()) {}

ProgressBar::~ProgressBar() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(const std::string& what, double fraction) {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  if (!on_terminal_ || elapsed.count() < 0.3) return;
  shown_ = true;
  const int columns = terminal_size(STDERR_FILENO).columns - 1;  // the last one may wrap
  const std::string line = progress_line(what, fraction, elapsed.count(), columns);
  std::fputs(fmt::format("\r{}\033[K", line).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace raytracer::client
