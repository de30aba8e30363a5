// The flags about files that leave open how they are to look.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "client/command_line.h"
#include "client/failure.h"
#include "client/formats/numbers.h"
#include "client/formats/particles/color_map.h"
#include "client/formats/screen_color.h"

namespace raytracer::client {
namespace {

model::Triple direction_of(const std::string& text) {
  model::Triple direction{};
  std::istringstream parts(text);
  std::size_t count = 0;
  for (std::string part; std::getline(parts, part, ','); ++count) {
    const auto value = number_of(part);
    constexpr double most = 1e100;
    if (!value || std::abs(*value) > most || count >= direction.size()) {
      count = 0;
      break;
    }
    direction[count] = *value;
  }
  if (count != direction.size() || direction == model::Triple{0, 0, 0})
    throw InputError(fmt::format("--view: '{}' is no direction; write x,y,z", text));
  return direction;
}

/// Of a colour as screens show it, "#rrggbb".
model::Background background_of(const std::string& text) {
  if (text == "transparent") return std::nullopt;
  if (text.size() != 7 || text[0] != '#' ||
      text.find_first_not_of("0123456789abcdefABCDEF", 1) != text.npos)
    throw InputError(
        fmt::format("--background: '{}' is no colour; write #rrggbb or transparent", text));
  const auto rgb = static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
  const model::Rgb light = linear(screen_color(rgb));
  return model::Triple{light[0], light[1], light[2]};
}

AtomStyle style_of(const std::string& name) {
  if (name == "sticks") return AtomStyle::sticks;
  return name == "spacefill" ? AtomStyle::spacefill : AtomStyle::ball_and_stick;
}

}  // namespace

void add_import_flags(CLI::App& command, SceneChoice& scene) {
  const auto add = [&](const std::string& flag, const std::string& value_name,
                       const std::string& help, auto take) {
    return command
        .add_option_function<std::string>(
            flag,
            [&scene, flag, take](const std::string& text) {
              scene.flags_given.push_back(flag);
              take(scene.import_options, text);
            },
            help)
        ->option_text(value_name)
        ->group("Molecules, particles and meshes");
  };
  add("--style", "spacefill|ball-and-stick|sticks", "How atoms are drawn [spacefill]",
      [](ImportOptions& options, const std::string& name) { options.style = style_of(name); })
      ->check(refuse_unless_among({"spacefill", "ball-and-stick", "sticks"}));
  add("--color", "COLUMN", "What gives the colours: element, chain, residue or a column",
      [](ImportOptions& options, const std::string& name) { options.color = name; });
  add("--colormap", "viridis|magma|coolwarm", "Colours of a column of numbers [viridis]",
      [](ImportOptions& options, const std::string& name) { options.color_map = name; })
      ->check(refuse_unless_among({color_maps.begin(), color_maps.end()}));
  add("--view", "X,Y,Z", "Seen from this direction [the file's camera, or where most is seen]",
      [](ImportOptions& options, const std::string& text) { options.view = direction_of(text); });
  add("--zoom", "Z", "Enlargement; 1 shows everything, or what the file's camera does [1]",
      [](ImportOptions& options, const std::string& text) { options.zoom = std::stod(text); })
      ->check(refuse_unless_positive);
  add("--background", "#rrggbb|transparent", "Background [#ffffff]",
      [](ImportOptions& options, const std::string& text) {
        options.background = background_of(text);
      });
  command
      .add_flag_callback(
          "--water",
          [&scene] {
            scene.flags_given.emplace_back("--water");
            scene.import_options.with_water = true;
          },
          "Show the water of a molecule's file")
      ->group("Molecules, particles and meshes");
}

}  // namespace raytracer::client
