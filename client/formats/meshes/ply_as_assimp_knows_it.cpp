#include "client/formats/meshes/ply_as_assimp_knows_it.h"

#include "client/formats/meshes/line_words.h"
#include "client/formats/meshes/ply_header.h"
#include "client/formats/reading.h"

namespace raytracer::client {
namespace {

/// Empty if it is text, or what is wrong with the header is said elsewhere.
std::string_view bytes_behind_header(std::string_view ply) {
  LineWords words(ply);
  if (words.next() != "ply") return {};
  try {
    const PlyHeader header = read_ply_header(words);
    return header.body && header.body != PlyBody::text ? words.rest_of_text() : std::string_view();
  } catch (const LineError&) {
    return {};
  }
}

}  // namespace

std::optional<std::string> ply_as_assimp_knows_it(std::string_view ply) {
  const std::string_view body = bytes_behind_header(ply);
  if (!body.starts_with('\n')) return std::nullopt;
  const std::string_view header = ply.substr(0, ply.size() - body.size());
  if (!header.ends_with('\n') || header.ends_with("\r\n")) return std::nullopt;
  std::string known(header.substr(0, header.size() - 1));
  known.reserve(ply.size() + 1);
  known += "\r\n";
  known += body;
  return known;
}

}  // namespace raytracer::client
