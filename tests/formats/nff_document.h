// NFF texts for tests, and the scene documents that they become.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "client/formats/nff/read_nff.h"

namespace raytracer::test {

/// Six lines.
inline const std::string nff_view =
    "v\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 90\nresolution 100 100\n";
inline const std::string nff_fill = "f 1 0.5 0.25 0.7 0.2 10 0 0\n";

/// Of a text that has no errors.
inline nlohmann::json nff_document(const std::string& text) {
  const client::Reading reading = client::read_nff(text);
  for (const client::LineError& error : reading.errors)
    ADD_FAILURE() << error.line << ": " << error.what;
  return nlohmann::json::parse(client::model::to_document(reading.scene));
}

/// Of a text with a viewpoint, a fill and this.
inline nlohmann::json nff_objects(const std::string& elements) {
  return nff_document(nff_view + nff_fill + elements).at("objects");
}

}  // namespace raytracer::test
