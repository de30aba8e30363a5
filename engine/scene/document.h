// JSON text as a flat array of nodes: what the reader walks instead of a tree of allocations.
//
// Limits: 2^32 nodes and bytes of text. Duplicate keys and numbers beyond a double are kept apart
// as errors, because the rest of the document is still worth checking.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/error_list.h"
#include "engine/scene/result.h"

namespace raytracer {

enum class JsonKind : std::uint8_t { null, boolean, number, string, array, object };

/// A parsed document: nodes in the order of the text, an object's members as key, value, key ...
struct Document {
  /// A piece of `text`.
  struct Span {
    std::uint32_t begin;
    std::uint32_t size;
  };
  struct Node {
    JsonKind kind = JsonKind::null;
    std::uint32_t end = 0;  ///< the index behind this value and all that it contains
    union {
      double number = 0;  ///< not a number where the text has one beyond all doubles
      Span string;
    };
  };

  std::vector<Node> nodes;  ///< nodes[0] is the whole document
  std::string text;         ///< all strings and keys, one behind the other
  ErrorList errors;         ///< duplicate keys, and numbers too large for a double
};

/// Parses `text` (UTF-8).
/// Errors: one, of kind syntax, with line and column; or invalid, for a document nested too deep.
Result<Document> parse_document(std::string_view text);

/// A value inside a document, which must outlive it.
class JsonValue {
 public:
  explicit JsonValue(const Document& document, std::uint32_t index = 0)
      : document_(&document), index_(index) {}

  JsonKind kind() const { return node().kind; }
  double number() const { return node().number; }
  std::string_view string() const {
    const Document::Span& place = node().string;
    return std::string_view(document_->text).substr(place.begin, place.size);
  }

  /// An upper bound of an array's length, cheap: for reserving memory.
  std::size_t node_count() const { return node().end - index_ - 1; }

  /// The first member of an object with that key.
  std::optional<JsonValue> member(std::string_view key) const {
    std::optional<JsonValue> found;
    for_each_member([&](std::string_view name, JsonValue value) {
      if (!found && name == key) found = value;
    });
    return found;
  }

  /// Calls visit(value) for each element of an array.
  template <typename Visit>
  void for_each_element(Visit visit) const {
    for (std::uint32_t i = index_ + 1; i < node().end; i = document_->nodes[i].end)
      visit(JsonValue(*document_, i));
  }

  /// Calls visit(key, value) for each member of an object, duplicates included.
  template <typename Visit>
  void for_each_member(Visit visit) const {
    for (std::uint32_t i = index_ + 1; i < node().end; i = document_->nodes[i + 1].end)
      visit(JsonValue(*document_, i).string(), JsonValue(*document_, i + 1));
  }

 private:
  const Document::Node& node() const { return document_->nodes[index_]; }

  const Document* document_;
  std::uint32_t index_;
};

}  // namespace raytracer
