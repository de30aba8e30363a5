// A text that may be longer than a message of NATS, in chunks.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "server/cluster/nats.h"

namespace raytracer {

inline constexpr std::size_t chunk_bytes = 512
                                           << 10;  // NATS takes 1 MB unless it is told otherwise

/// How many chunks so many bytes make, and each of them.
inline std::size_t chunks_in(std::size_t bytes) { return (bytes + chunk_bytes - 1) / chunk_bytes; }
inline std::string_view chunk(std::string_view text, std::size_t index) {
  return text.substr(index * chunk_bytes, chunk_bytes);
}

/// Under PREFIX.text.NAME stands of what it consists, under PREFIX.chunk.NAME.K each chunk. Every
/// member function throws as NatsConnection's do.
class StoredText {
 public:
  StoredText(NatsConnection& nats, std::string stream, std::string prefix, std::string name);

  /// The names of all that is stored, whole or not.
  static std::set<std::string> names(NatsConnection& nats, const std::string& stream,
                                     const std::string& prefix);

  /// Whether it is there, whole, and not as old as `most_age`.
  bool is_stored(std::string_view text, std::chrono::milliseconds most_age) const;
  void put(std::string_view text) const;
  /// Nothing if it is not there, or damaged.
  std::optional<std::string> get() const;
  void remove() const;

 private:
  std::string head() const { return prefix_ + ".text." + name_; }
  std::string chunk_at(std::string_view index) const;

  NatsConnection& nats_;
  const std::string stream_;
  const std::string prefix_;
  const std::string name_;
};

}  // namespace raytracer
