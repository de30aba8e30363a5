#include "engine/scene/nearest_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>

namespace raytracer {
namespace {

/// A longer word is no slip of the finger: only its start is compared.
constexpr std::size_t longest = 64;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Without capitals: one is less of a slip than another letter.
std::string start_of(std::string_view word) {
  std::string start(word.substr(0, longest));
  std::transform(start.begin(), start.end(), start.begin(), lower);
  return start;
}

/// Optimal string alignment distance, by dynamic programming over their beginnings.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::array<std::array<std::size_t, longest + 1>, longest + 1> of;
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      of[i][j] = std::max(i, j);
      if (i == 0 || j == 0) continue;
      const std::size_t substituted = of[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      of[i][j] = std::min({of[i - 1][j] + 1, of[i][j - 1] + 1, substituted});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        of[i][j] = std::min(of[i][j], of[i - 2][j - 2] + 1);
    }
  return of[a.size()][b.size()];
}

struct Nearest {
  std::string_view word;
  std::size_t distance = std::numeric_limits<std::size_t>::max();
};

Nearest nearest(std::string_view word, std::span<const std::string_view> known) {
  const std::string start = start_of(word);
  Nearest nearest;
  for (const std::string_view candidate : known)
    if (const std::size_t distance = edit_distance(start, start_of(candidate));
        distance < nearest.distance)
      nearest = {candidate, distance};
  return nearest;
}

}  // namespace

std::string_view nearest_key(std::string_view word, std::span<const std::string_view> known) {
  return nearest(word, known).word;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  const Nearest key = nearest(word, known);
  const std::size_t longer = std::min(std::max(word.size(), key.word.size()), longest);
  constexpr std::size_t one_in = 3;
  if (key.distance > (longer + one_in - 1) / one_in) return {};
  return fmt::format("; did you mean \"{}\"?", key.word);
}

}  // namespace raytracer
