#include "server/etag.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <stdexcept>

#include "engine/engine.h"
#include "server/header_text.h"

namespace raytracer {

std::string sha256_hex(std::string_view bytes) {
  // EVP_sha256() would be looked up at each use, behind a lock.
  static EVP_MD* const sha256 = EVP_MD_fetch(nullptr, "SHA256", nullptr);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (sha256 == nullptr ||
      EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, sha256, nullptr) != 1)
    throw std::runtime_error("OpenSSL does not compute SHA-256");
  constexpr std::string_view digits = "0123456789abcdef";
  std::string hex;
  hex.reserve(2 * std::size_t{length});
  for (unsigned int i = 0; i < length; ++i) {
    hex += digits[digest[i] >> 4U];
    hex += digits[digest[i] & 0xFU];
  }
  return hex;
}

std::string content_digest(const Scene& scene) { return sha256_hex(canonical_content(scene)); }

std::string picture_digest(std::string_view content_digest, const Scene& view) {
  return sha256_hex(fmt::format("{}\n{}", content_digest, canonical_view(view)));
}

std::string maker_of_pictures(const Machine& machine) {
  return fmt::format("{}\n{}\n{}", build_id, machine.instruction_set.name, processor_model());
}

std::string entity_tag(std::string_view picture_digest, std::string_view media_type,
                       std::string_view maker) {
  const std::string digest =
      sha256_hex(fmt::format("{}\n{}\n{}", picture_digest, media_type, maker));
  return fmt::format("\"{}\"", std::string_view(digest).substr(0, 32));
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
