// Any bytes as a file of particles, of the format whose words it begins with: its frames become
// documents that are JSON, or have errors.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "client/failure.h"
#include "client/formats/format.h"

namespace {

using namespace raytracer::client;

std::string_view ending_of(std::string_view text) {
  struct Mark {
    std::string_view word;
    std::string_view ending;
  };
  constexpr std::array marks{Mark{"ITEM:", ".dump"}, Mark{"_atom_site", ".cif"},
                             Mark{"HETATM", ".pdb"}, Mark{"ATOM  ", ".pdb"},
                             Mark{",", ".csv"},      Mark{"\t", ".tsv"}};
  for (const Mark& mark : marks)
    if (text.substr(0, 400).find(mark.word) != text.npos) return mark.ending;
  return ".xyz";
}

}  // namespace

// The name is libFuzzer's.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ImportOptions options;
  options.style = static_cast<AtomStyle>(size % 3);
  if (size % 5 == 0) options.color = "v";
  options.is_turned = size % 7 == 0;
  try {
    const auto file = format_of(ending_of(text))->open({source_of_text(text), ""}, options);
    while (const auto frame = file->next_frame())
      if (frame->errors.empty() && !nlohmann::json::accept(model::to_document(frame->scene)))
        std::abort();
  } catch (const InputError&) {
    // said, without a line
  }
  return 0;
}
