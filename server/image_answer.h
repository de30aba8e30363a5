// A picture as an HTTP answer: its bytes in the format that the client prefers, and the header
// fields that say what it is and how it came about.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/engine.h"
#include "server/call.h"
#include "server/image_cache.h"

namespace raytracer {

/// As Content-Type and Accept name the format.
std::string_view media_type(ImageFormat format);

/// The format that the request's Accept prefers (RFC 9110, 12.5.1): the highest weight, the most
/// specific range deciding each format's weight and png, ppm, pfm the order of equals. Without the
/// field everything is accepted; ranges that cannot be read count for nothing. Only formats that
/// hold an image of so many channels are offered. Throws HttpError 406.
ImageFormat require_format(const httplib::Request& request, int channels = 3);

/// Whether Accept prefers a format that holds floats to those that hold 8 bits.
bool prefers_floats(const httplib::Request& request);

/// What is to be answered.
struct Representation {
  ImageFormat format;
  std::optional<std::string> tag{};  ///< of the picture, if the same request would give it again
};

/// The picture in this format, with the tag that it has as `renderer_id` draws it. Without a digest
/// it has none, since the next render gives other bytes.
Representation represent(const std::optional<std::string>& picture_digest, ImageFormat format,
                         std::string_view renderer_id);

/// Whether the client insists on a new picture: Cache-Control: no-cache.
bool forbids_cache(const httplib::Request& request);

/// Answers what needs no drawing: 304 if the client has this picture already and does not insist,
/// the fields that a GET would have to HEAD. Returns whether it did.
bool answer_without_image(Call& call, const Representation& wanted);

/// The picture with all its fields. One that has no tag yet is given that of its bytes, and is 304
/// to a client that has them already.
void answer_image(Call& call, const Delivery& delivery, double parse_ms,
                  const Representation& wanted);

}  // namespace raytracer
