// How much one request may ask for: one table, which names each limit once for everybody.
//
// The reader enforces the limits, the server derives its flags, its variables and its answers
// from the table, so a refusal can always name the flag that would lift it.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>

namespace raytracer {

/// The most that is accepted; see `limit_table` for what each counts.
struct Limits {
  std::int64_t body = 128LL << 20;
  std::int64_t pixels = 4096LL * 4096;
  std::int64_t objects = 4'000'000;
  std::int64_t lights = 1'000;
  std::int64_t samples = 65'536;
  std::int64_t work = 4'000'000'000;
};

/// One row: how a limit is called and where it stands.
struct LimitRow {
  std::int64_t Limits::*value;
  const char* flag;      ///< "--max-pixels"
  const char* variable;  ///< "RAYTRACER_MAX_PIXELS"
  const char* meaning;   ///< for --help and /version
  std::int64_t largest;  ///< the flag itself takes 1 to this
};

inline constexpr std::int64_t deepest_nesting = 64;  ///< of JSON values; a scene needs 6

inline constexpr std::array<LimitRow, 6> limit_table{{
    {&Limits::body, "--max-body", "RAYTRACER_MAX_BODY", "bytes in a request's body", 1LL << 31},
    // A float image of 2^29 pixels is 6 GiB; stb_image_write counts bytes in an int, one more than
    // the pixels' for each row.
    {&Limits::pixels, "--max-pixels", "RAYTRACER_MAX_PIXELS", "pixels in an image",
     (1LL << 29) - 1},
    {&Limits::objects, "--max-objects", "RAYTRACER_MAX_OBJECTS",
     "objects in a scene, each sphere of a set and each triangle of a mesh counted", 1'000'000'000},
    // A plan looks at all objects from each point light.
    {&Limits::lights, "--max-lights", "RAYTRACER_MAX_LIGHTS", "lights in a scene", 1'000'000},
    {&Limits::samples, "--max-samples", "RAYTRACER_MAX_SAMPLES", "samples per pixel", 1 << 30},
    // More where a surface gives back more than it receives: work_of() says how many.
    {&Limits::work, "--max-work", "RAYTRACER_MAX_WORK",
     "rays in all: pixels x samples x (1 + max_depth where surfaces reflect or refract)",
     1LL << 62},
}};

/// The row of `limit`, for a message that names its flag.
constexpr const LimitRow& row_of(std::int64_t Limits::*limit) {
  for (const LimitRow& row : limit_table)
    if (row.value == limit) return row;
  throw std::logic_error("a limit that is not in the table");
}

}  // namespace raytracer
