// The parser for documents without errors, at the speed of their bytes.
//
// It knows one thing to say about an error: nothing. Whatever it does not like is read again by
// parse_thoroughly, which decides; so it may be stricter, but must never be laxer.
#pragma once

#include <optional>
#include <string_view>

#include "engine/scene/document.h"

namespace raytracer {

/// The document as parse_thoroughly makes it, but that strings may be pieces of `text` and arrays
/// of numbers have no nodes; nothing if it has any error, or is odd in another way.
std::optional<Document> parse_quickly(std::string_view text);

}  // namespace raytracer
