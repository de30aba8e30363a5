// Any bytes as a scene document: it is read, or all of its errors are said, and the same with room
// behind the text, where it is not copied.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "engine/engine.h"

// The name is libFuzzer's.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto scene = raytracer::read_scene(text, {});
  if (!scene.ok() && scene.errors().empty()) std::abort();

  std::string roomy;
  roomy.reserve(size + raytracer::DocumentText::read_ahead);
  roomy = text;
  const auto alike = raytracer::read_scene(roomy, {});
  if (alike.ok() != scene.ok()) std::abort();
  if (!scene.ok() && alike.errors().size() != scene.errors().size()) std::abort();
  return 0;
}
