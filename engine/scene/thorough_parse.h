// The parser that finds every error and says where it is.
#pragma once

#include <string_view>

#include "engine/scene/document.h"
#include "engine/scene/result.h"

namespace raytracer {

/// As parse_document: this is its definition, at ten times the price of parse_quickly.
Result<Document> parse_thoroughly(std::string_view text);

}  // namespace raytracer
