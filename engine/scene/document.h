// JSON text as a flat array of nodes: what the reader walks instead of a tree of allocations.
//
// Limits: 2^32 nodes and bytes of text. Duplicate keys and numbers beyond a double are kept apart
// as errors, because the rest of the document is still worth checking.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/memory/page_allocator.h"
#include "engine/scene/error_list.h"
#include "engine/scene/result.h"

namespace raytracer {

enum class JsonKind : std::uint8_t { null, boolean, number, string, array, object };

/// A parsed document: nodes in the order of the text, an object's members as key, value, key ...
struct Document {
  struct Span {
    std::uint32_t begin;
    std::uint32_t size;
  };
  struct Node {
    JsonKind kind = JsonKind::null;
    std::uint32_t end = 0;  ///< the index behind this value and all that it contains
    union {
      double number = 0;  ///< of true 1; not a number where the text has one beyond all doubles
      Span string;        ///< a piece of `source`, or behind its end of `text`
      Span numbers;       ///< of an array: a piece of `numbers` instead of nodes, if not empty
    };
  };

  std::string_view source;     ///< strings without escapes stay where they are
  LargeArray<Node> nodes;      ///< nodes[0] is the whole document
  LargeArray<double> numbers;  ///< those of arrays of nothing else
  std::string text;            ///< other strings and keys, one behind the other
  ErrorList errors;            ///< duplicate keys, and numbers too large for a double

  std::string_view string(const Span& place) const {
    if (place.begin < source.size()) return source.substr(place.begin, place.size);
    return std::string_view(text).substr(place.begin - source.size(), place.size);
  }
};

/// Parses `text` (UTF-8), which must outlive the document.
/// Errors: one, of kind syntax, with line and column; or invalid, for a document nested too deep.
Result<Document> parse_document(std::string_view text);

/// A value inside a document, which must outlive it.
class JsonValue {
 public:
  explicit JsonValue(const Document& document, std::uint32_t index = 0)
      : document_(&document), index_(index) {}

  JsonKind kind() const { return document_ == nullptr ? JsonKind::number : node().kind; }
  double number() const { return document_ == nullptr ? number_ : node().number; }
  bool boolean() const { return node().number != 0; }
  std::string_view string() const { return document_->string(node().string); }

  /// The elements of an array of numbers; nothing if it has others, or they are kept as nodes.
  std::span<const double> numbers() const {
    if (kind() != JsonKind::array) return {};
    return std::span(document_->numbers).subspan(node().numbers.begin, node().numbers.size);
  }

  /// How many nodes an array's elements take, cheap: for reserving memory.
  std::size_t node_count() const { return node().end - index_ - 1; }

  /// The first member of an object with that key.
  std::optional<JsonValue> member(std::string_view key) const {
    for (std::uint32_t i = index_ + 1; i < node().end; i = document_->nodes[i + 1].end)
      if (JsonValue(*document_, i).string() == key) return JsonValue(*document_, i + 1);
    return {};
  }

  /// Calls visit(value) for each element of an array.
  template <typename Visit>
  void for_each_element(Visit visit) const {
    for (const double number : numbers()) visit(JsonValue(number));
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
  explicit JsonValue(double number) : number_(number) {}

  const Document::Node& node() const { return document_->nodes[index_]; }

  const Document* document_ = nullptr;  ///< null for an element of numbers()
  std::uint32_t index_ = 0;
  double number_ = 0;
};

}  // namespace raytracer
