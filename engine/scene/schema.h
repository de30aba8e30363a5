// The scene document as JSON Schema, made from the tables that the reader goes by.
#pragma once

#include <string>

namespace raytracer {

/// JSON Schema (draft 2020-12) of a scene document. What it cannot say the reader checks: see its
/// description.
std::string scene_schema();

}  // namespace raytracer
