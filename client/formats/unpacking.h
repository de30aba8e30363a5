// Compressed bytes as they were, some at a time: gzip by zlib, Zstandard by libzstd.
#pragma once

#include <memory>

#include "client/formats/text_source.h"

namespace raytracer::client {

/// Throws InputError from read() where the data is damaged or ends early.
std::unique_ptr<TextSource> gunzip(std::unique_ptr<TextSource> packed);
std::unique_ptr<TextSource> unzstd(std::unique_ptr<TextSource> packed);

}  // namespace raytracer::client
