#include "server/cluster/stored_text.h"

#include <fmt/format.h>

#include <charconv>
#include <utility>

#include "server/cluster/record.h"
#include "server/digest.h"

namespace raytracer {
namespace {

constexpr std::string_view before_count = "parts ";  // alone with the count, of earlier builds

/// What the head says: two texts of one name may have been stored at a time.
std::string description_of(std::string_view text) {
  return fmt::format("{}{} {}", before_count, chunks_in(text.size()), sha256_hex(text));
}

}  // namespace

StoredText::StoredText(NatsConnection& nats, std::string stream, std::string prefix,
                       std::string name)
    : nats_(nats), stream_(std::move(stream)), prefix_(std::move(prefix)), name_(std::move(name)) {}

std::string StoredText::chunk_at(std::string_view index) const {
  return fmt::format("{}.chunk.{}.{}", prefix_, name_, index);
}

std::set<std::string> StoredText::names(NatsConnection& nats, const std::string& stream,
                                        const std::string& prefix) {
  std::set<std::string> names;
  for (const char* const kind : {".text.*", ".chunk.*.*"})
    for (const std::string& subject : nats.subjects(stream, prefix + kind)) {
      const std::size_t begin = prefix.size() + std::string_view(kind).find('*');
      names.insert(subject.substr(begin, subject.find('.', begin) - begin));
    }
  return names;
}

bool StoredText::is_stored(std::string_view text, std::chrono::milliseconds most_age) const {
  // Chunks were stored before the head, so they go before it.
  const auto found = nats_.get(stream_, head());
  return found && found->data == description_of(text) &&
         now_ms() - found->time_ms < most_age.count() &&
         nats_.subjects(stream_, chunk_at("*")).size() == chunks_in(text.size());
}

void StoredText::put(std::string_view text) const {
  for (std::size_t i = 0; i < chunks_in(text.size()); ++i)
    nats_.put(chunk_at(std::to_string(i)), chunk(text, i));
  nats_.put(head(), description_of(text));
}

std::optional<std::string> StoredText::get() const {
  const auto found = nats_.get(stream_, head());
  if (!found) return {};
  std::size_t count = 0;
  if (!found->data.starts_with(before_count)) return {};
  const char* const end = found->data.data() + found->data.size();
  const char* const stop =
      std::from_chars(found->data.data() + before_count.size(), end, count).ptr;
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    const auto part = nats_.get(stream_, chunk_at(std::to_string(i)));
    if (!part) return {};
    text += part->data;
  }
  if (stop != end && description_of(text) != found->data) return {};
  return text;
}

void StoredText::remove() const {
  nats_.purge(stream_, head());
  nats_.purge(stream_, chunk_at("*"));
}

}  // namespace raytracer
