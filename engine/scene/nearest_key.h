// "Did you mean": the known word that an unknown one most likely stands for.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace raytracer {

/// The word of `known` with the least edit distance (optimal string alignment: insertions,
/// deletions, substitutions, swaps of neighbours) to `word`, the first of equals, whatever the
/// distance; empty if `known` is.
std::string_view nearest_key(std::string_view word, std::span<const std::string_view> known);

/// `; did you mean "NEAREST"?`, or nothing if more than a third of the letters would have slipped.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

}  // namespace raytracer
