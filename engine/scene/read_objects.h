// The array "objects": each element by its "type".
#pragma once

#include <vector>

#include "engine/scene/fields.h"
#include "engine/scene/materials.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// The objects as far as they are right, in the document's order.
std::vector<Object> read_objects(const Field& field, MaterialReader& materials);

}  // namespace raytracer
