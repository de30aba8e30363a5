// Which engine made a picture: part of every entity tag.
#pragma once

namespace raytracer {

inline constexpr const char* version = "0.1.0";

/// A digest of the engine's sources: two engines with the same id draw the same bytes (on the same
/// kind of machine).
extern const char* const build_id;

}  // namespace raytracer
