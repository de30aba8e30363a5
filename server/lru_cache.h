// Values by their keys, as many bytes of them as allowed; what was used least recently goes first.
//
// Values are shared and never change, so one that is forgotten lives on for as long as somebody
// uses it: the bound is on what is kept for nobody in particular.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace raytracer {

/// What became of the look-ups so far, and what is kept now.
struct LruCounts {
  std::uint64_t hits = 0;
  std::uint64_t misses = 0;
  std::uint64_t evictions = 0;
  std::size_t entries = 0;
  std::size_t bytes = 0;
};

/// What becomes of a value that is larger than all that may be kept.
enum class Oversized {
  forgotten,
  kept_alone,  ///< until another comes: where it is used again and again, and dear to make
};

/// Every member function may be called from any thread.
template <typename Value>
class LruCache {
 public:
  explicit LruCache(std::size_t most_bytes, Oversized oversized = Oversized::forgotten)
      : most_bytes_(most_bytes), oversized_(oversized) {}

  std::size_t most_bytes() const { return most_bytes_; }

  /// Null if it is not kept; otherwise it was used just now.
  std::shared_ptr<const Value> find(std::string_view key) {
    const std::scoped_lock lock(mutex_);
    const auto place = places_.find(key);
    if (place == places_.end()) {
      ++counts_.misses;
      return nullptr;
    }
    ++counts_.hits;
    entries_.splice(entries_.begin(), entries_, place->second);
    return place->second->value;
  }

  /// Whether it is kept; it was not used by that.
  bool contains(std::string_view key) const {
    const std::scoped_lock lock(mutex_);
    return places_.contains(key);
  }

  /// Keeps the value, in place of another with the same key; does nothing and returns false if it
  /// is oversized, and such are forgotten. `bytes` is what it takes, its key included.
  bool keep(std::string key, std::shared_ptr<const Value> value, std::size_t bytes) {
    if (bytes > most_bytes_ && oversized_ == Oversized::forgotten) return false;
    std::list<Entry> forgotten;  // large ones take long to destroy: after the lock
    const std::scoped_lock lock(mutex_);
    if (const auto before = places_.find(key); before != places_.end())
      forget(before->second, forgotten);
    entries_.push_front({std::move(key), std::move(value), bytes});
    counts_.bytes += bytes;
    places_.emplace(entries_.front().key, entries_.begin());
    while (counts_.bytes > most_bytes_ && entries_.size() > 1) {
      forget(std::prev(entries_.end()), forgotten);
      ++counts_.evictions;
    }
    return true;
  }

  LruCounts counts() const {
    const std::scoped_lock lock(mutex_);
    LruCounts counts = counts_;
    counts.entries = entries_.size();
    return counts;
  }

 private:
  struct Entry {
    std::string key;
    std::shared_ptr<const Value> value;
    std::size_t bytes;
  };
  using Place = typename std::list<Entry>::iterator;

  void forget(Place entry, std::list<Entry>& forgotten) {
    counts_.bytes -= entry->bytes;
    places_.erase(entry->key);
    forgotten.splice(forgotten.end(), entries_, entry);
  }

  const std::size_t most_bytes_;
  const Oversized oversized_;
  mutable std::mutex mutex_;
  std::list<Entry> entries_;                            ///< the most recently used first
  std::unordered_map<std::string_view, Place> places_;  ///< by the entries' own keys
  LruCounts counts_;
};

}  // namespace raytracer
