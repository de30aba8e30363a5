#include "engine/scene/document.h"

#include "engine/scene/quick_parse.h"
#include "engine/scene/thorough_parse.h"

namespace raytracer {

Result<Document> parse_document(std::string_view text) {
  if (std::optional<Document> document = parse_quickly(text)) return *std::move(document);
  return parse_thoroughly(text);
}

}  // namespace raytracer
