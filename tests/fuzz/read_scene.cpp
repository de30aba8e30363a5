// Any bytes as a scene document: it is read, or all of its errors are said.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "engine/engine.h"

// The name is libFuzzer's.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto scene = raytracer::read_scene({reinterpret_cast<const char*>(data), size}, {});
  if (!scene.ok() && scene.errors().empty()) std::abort();
  return 0;
}
