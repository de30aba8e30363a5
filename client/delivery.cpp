#include "client/delivery.h"

#include <fmt/format.h>
#include <unistd.h>

#include <sstream>
#include <string_view>

#include "client/image_format.h"
#include "client/notice.h"
#include "client/terminal.h"
#include "client/terminal_picture.h"

namespace raytracer::client {
namespace {

/// "queue;dur=0.1, trace;dur=42" as "queue 0.1 ms, trace 42 ms"
std::string stage_times(const std::string& server_timing) {
  std::string times;
  std::istringstream stages(server_timing);
  for (std::string stage; std::getline(stages >> std::ws, stage, ',');) {
    constexpr std::string_view mark = ";dur=";
    const std::size_t at = stage.find(mark);
    if (at == stage.npos) continue;
    times += fmt::format("{}{} {} ms", times.empty() ? "" : ", ", stage.substr(0, at),
                         stage.substr(at + mark.size()));
  }
  return times;
}

/// One line: where it went, what it is, how it was made.
std::string summary(const std::string& place, const RenderedImage& image) {
  std::string line = place;
  if (const auto size = image_size(image.bytes))
    line += fmt::format(": {} x {}", size->width_px, size->height_px);
  const auto add = [&](const char* before, const std::string& value, const char* after) {
    if (!value.empty()) line += fmt::format(", {}{}{}", before, value, after);
  };
  add("", image.samples, " samples per pixel");
  add("", image.precision, " precision");
  add("error ", image.error, "");
  add("ended by ", image.stop, "");
  if (!image.server_timing.empty()) line += "; " + stage_times(image.server_timing);
  return line;
}

}  // namespace

Delivery::Delivery(const std::optional<OutputFile>& file)
    : file_(file), into_terminal_(!file && ::isatty(STDOUT_FILENO) == 1) {
  if (file_) file_->check_writable();
}

std::string Delivery::media_type() const {
  if (into_terminal_)
    return fmt::format("{}, {};q=0.5", ppm_format.media_type, png_format.media_type);
  if (!file_) return std::string(png_format.media_type);
  return std::string(image_format_of(file_->ending())->media_type);
}

void Delivery::operator()(const RenderedImage& image, const std::string& label) const {
  if (file_) {
    file_->write(image.bytes);
  } else if (into_terminal_) {
    TerminalSize room = terminal_size(STDOUT_FILENO);
    room.rows -= 3;  // the line about the image, which may wrap, and the prompt
    write_to_standard_output(terminal_picture(image.bytes, room));
  } else {
    write_to_standard_output(image.bytes);
  }
  notice(summary(file_ ? file_->path.string() : label, image));
}

}  // namespace raytracer::client
