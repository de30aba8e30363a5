// JSON text as what the reader walks: simdjson's document, which is strict and fast, and what is
// wrong with the text that simdjson takes for right.
//
// Limits: 2^32 bytes of text.
#pragma once

#include <simdjson.h>

#include "engine/scene/document_text.h"
#include "engine/scene/error_list.h"
#include "engine/scene/result.h"

namespace raytracer {

/// Values inside a document, which must outlive them.
using JsonValue = simdjson::dom::element;
using JsonArray = simdjson::dom::array;
using JsonObject = simdjson::dom::object;

struct Document {
  simdjson::dom::document json;
  ErrorList errors;  ///< keys that stand twice in an object, and numbers too large for a double

  JsonValue root() const { return json.root(); }
};

/// Parses a text. A number too large for a double stands there as null.
/// Errors: one, of kind syntax, with line and column; or invalid, for a document nested too deep.
Result<Document> parse_document(const DocumentText& text);

}  // namespace raytracer
