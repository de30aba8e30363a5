// Raw video for a pipe, YUV4MPEG2 (mjpegtools' yuv4mpeg(5)), as every encoder reads it: colours of
// ITU-R BT.601 in their limited range, with one colour for each square of four pixels.
#pragma once

#include <string>
#include <string_view>

#include "client/apng.h"
#include "client/image_format.h"

namespace raytracer::client {

/// What a stream begins with.
std::string y4m_header(ImageSize size, FrameRate rate);

/// Of a P6. Throws ServerError if it is none.
std::string y4m_frame(std::string_view ppm);

}  // namespace raytracer::client
