#include "server/etag.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <memory>
#include <stdexcept>

#include "engine/engine.h"
#include "server/request_text.h"

namespace raytracer {
namespace {

constexpr std::size_t tag_digits = 32;

}  // namespace

std::string sha256_hex(std::string_view bytes) {
  // EVP_sha256() would be looked up at each use, behind a lock; and of a short text OpenSSL takes
  // as long to make and free a context as to compute the digest.
  static EVP_MD* const sha256 = EVP_MD_fetch(nullptr, "SHA256", nullptr);
  thread_local const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(
      EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (sha256 == nullptr || context == nullptr ||
      EVP_DigestInit_ex2(context.get(), sha256, nullptr) != 1 ||
      EVP_DigestUpdate(context.get(), bytes.data(), bytes.size()) != 1 ||
      EVP_DigestFinal_ex(context.get(), digest.data(), &length) != 1)
    throw std::runtime_error("OpenSSL does not compute SHA-256");
  // Digit by digit: fmt takes 1 us more, of the 57 that the smallest picture takes.
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
