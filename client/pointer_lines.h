// On which lines of a JSON text the values of JSON Pointers (RFC 6901) stand: what an editor can
// jump to.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace raytracer::client {

/// The lines, counted from 1, of the pointers and of all that they lie in (of "/camera/fov" also
/// "" and "/camera"), without those that are not there; where a key stands twice, of the latter.
/// `text` is valid JSON and is read once.
std::map<std::string, int> lines_of(const std::vector<std::string>& pointers,
                                    const std::string& text);

}  // namespace raytracer::client
