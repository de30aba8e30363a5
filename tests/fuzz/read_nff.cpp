// Any bytes as a file in Haines' Neutral File Format: it becomes a document that is JSON, or has
// errors.
#include "client/formats/nff/read_nff.h"

#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

// The name is libFuzzer's.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace raytracer::client;
  const Reading reading = read_nff({reinterpret_cast<const char*>(data), size});
  if (reading.errors.empty() && !nlohmann::json::accept(model::to_document(reading.scene)))
    std::abort();
  return 0;
}
