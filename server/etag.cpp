#include "server/etag.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <stdexcept>

#include "engine/engine.h"
#include "server/header_text.h"

namespace raytracer {

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("OpenSSL does not compute SHA-256");
  std::string hex;
  for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

std::string content_digest(const Scene& scene) { return sha256_hex(canonical_content(scene)); }

std::string picture_digest(std::string_view content_digest, const Scene& view) {
  return sha256_hex(fmt::format("{}\n{}", content_digest, canonical_view(view)));
}

std::string entity_tag(std::string_view picture_digest, std::string_view media_type) {
  const std::string digest =
      sha256_hex(fmt::format("{}\n{}\n{}\n{}\n{}", picture_digest, media_type, build_id,
                             this_machine().instruction_set.name, processor_model()));
  return fmt::format("\"{}\"", digest.substr(0, 32));
}

bool names_tag(std::string_view if_none_match, std::string_view tag) {
  bool found = false;
  for_each_part(if_none_match, ',', [&](std::string_view candidate) {
    if (candidate.starts_with("W/")) candidate.remove_prefix(2);
    found = found || candidate == "*" || candidate == tag;
  });
  return found;
}

}  // namespace raytracer
