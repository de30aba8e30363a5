// From a request to the scene that it wants drawn.
#pragma once

#include <string>
#include <string_view>

#include "server/call.h"
#include "server/query.h"
#include "server/scenes.h"
#include "server/services.h"

namespace raytracer {

/// What was posted, and its share of the memory for that.
struct PostedDocument {
  std::string text;
  Quota::Share memory;
};

/// The body. Throws HttpError if it is late or too much for now, and 503 while draining.
PostedDocument read_document(Call& call, Services& services);

/// The scene that the query names, or else the document's, with the query's values over its own.
/// Throws HttpError for everything that can be wrong with either.
SceneView find_scene(const DocumentText& document, const RenderQuery& query, Services& services);

/// Alike, with the request's body as the document: it is gone once it was read, the scene has all
/// of it, unless the scene may have to travel. Throws HttpError, 503 while draining.
SceneView read_scene_request(Call& call, const RenderQuery& query, Services& services);

}  // namespace raytracer
