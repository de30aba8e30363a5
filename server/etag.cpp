#include "server/etag.h"

#include <fmt/format.h>

#include "engine/engine.h"
#include "server/digest.h"
#include "server/request_text.h"

namespace raytracer {
namespace {

constexpr std::size_t tag_digits = 32;

}  // namespace

std::string content_digest(const Scene& scene) { return sha256_hex(canonical_content(scene)); }

std::string picture_digest(std::string_view content_digest, const Scene& view) {
  return sha256_hex(fmt::format("{}\n{}", content_digest, canonical_view(view)));
}

std::string renderer_id_of(const Machine& machine) {
  constexpr std::size_t digits = 16;  // nobody but this program chooses what they are made from
  return sha256_hex(
             fmt::format("{}\n{}\n{}", build_id, machine.instruction_set.name, processor_model()))
      .substr(0, digits);
}

std::string entity_tag(std::string_view picture_digest, std::string_view media_type,
                       std::string_view renderer_id) {
  return fmt::format("\"{}-{}-{}\"", picture_digest.substr(0, tag_digits), media_type, renderer_id);
}

std::string entity_tag_of_bytes(std::string_view bytes) {
  return fmt::format("\"{}\"", std::string_view(sha256_hex(bytes)).substr(0, tag_digits));
}

bool matches_tag(std::string_view if_none_match, std::string_view tag) {
  for (std::string_view candidate : parts_of(if_none_match, ',')) {
    if (candidate.starts_with("W/")) candidate.remove_prefix(2);
    if (candidate == "*" || candidate == tag) return true;
  }
  return false;
}

}  // namespace raytracer
