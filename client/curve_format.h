// The forms of a curve by the ending of its file, and the one that is a table.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "client/curve.h"

namespace raytracer::client {

enum class CurveFormat { svg, json, csv };

inline constexpr std::string_view known_curve_endings = ".svg, .json and .csv";

/// The form that the path's ending names, in upper or lower case.
std::optional<CurveFormat> curve_format_of(const std::filesystem::path& path);

/// A line of names, then a line for each point; empty where the scene's own value stands.
std::string csv(const Curve& curve);

}  // namespace raytracer::client
