// A picture as an HTTP answer: its bytes in the format that the client prefers, and the header
// fields that say what it is and how it came about.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/engine.h"
#include "server/call.h"
#include "server/image_cache.h"
#include "server/scene_request.h"

namespace raytracer {

/// What decides the picture, as a digest, if the same request would give the same bytes again.
/// A time budget does not: how far it gets differs from run to run, so such pictures carry no
/// entity tag and are not to be stored.
using Reproducible = std::optional<std::string>;
Reproducible reproducible_digest(const SceneRequest& request);

/// The format that the call's Accept asks for. Throws HttpError 406.
ImageFormat require_format(const httplib::Request& request);

/// What is to be answered.
struct Representation {
  ImageFormat format;
  std::optional<std::string> tag;  ///< its entity tag, if the same request would give it again
};
Representation represent(const Reproducible& digest, ImageFormat format,
                         std::string_view renderer_id);

/// Answers 304 if the client has this picture already and does not insist (Cache-Control:
/// no-cache); returns whether it did.
bool answer_not_modified(Call& call, const Representation& wanted);

/// What the call asks ImageCache for.
ImageRequest image_request(const Call& call, const Representation& wanted);

/// The picture, with its stages as far as this call waited for them.
void answer_image(Call& call, const Delivery& delivery, double parse_ms,
                  const Representation& wanted);

/// The fields that a GET would have, without drawing anything: for HEAD.
void answer_image_head(Call& call, const Representation& wanted);

}  // namespace raytracer
