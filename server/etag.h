// Entity tags: which bytes an image request is about, known without rendering.
//
// A tag names everything that decides the bytes: the canonical scene with the query's values
// applied, as SHA-256 cut to 128 bits, the media type, and by a digest the engine's build, and the
// instruction set and processor that it runs on: two makers' estimates of a root differ in their
// last bits. Only where time decides the bytes are they themselves what the tag is made from.
#pragma once

#include <string>
#include <string_view>

#include "engine/engine.h"

namespace raytracer {

/// Hexadecimal digest of what stands in the scene: the same for all views of it.
std::string content_digest(const Scene& scene);

/// Hexadecimal digest of everything that decides the picture. Takes the same time for every scene.
std::string picture_digest(std::string_view content_digest, const Scene& view);

/// Who draws: a digest of this build, the machine's instruction set, its processor. Slow, as asking
/// a virtual machine's processor for its name is: to be asked once.
std::string renderer_id_of(const Machine& machine);

/// The strong entity tag, with its quotes, of the picture as `renderer_id` draws it in one media
/// type.
std::string entity_tag(std::string_view picture_digest, std::string_view media_type,
                       std::string_view renderer_id);

/// The strong entity tag, with its quotes, of these bytes.
std::string entity_tag_of_bytes(std::string_view bytes);

/// Whether an If-None-Match field names `tag`, by weak comparison (RFC 9110, 13.1.2), or is "*".
bool matches_tag(std::string_view if_none_match, std::string_view tag);

}  // namespace raytracer
