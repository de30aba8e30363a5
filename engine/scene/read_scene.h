// JSON text to a Scene, or all of its errors: the first step of every render.
#pragma once

#include "engine/scene/document_text.h"
#include "engine/scene/limits.h"
#include "engine/scene/overrides.h"
#include "engine/scene/result.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// A scene and one view of it, which share what is in it.
struct ViewedScene {
  Scene scene;  ///< as the document says it, within the limit of objects only
  Scene view;   ///< with the overrides, within all limits
};

/// Reads a scene document, version 1.1.
/// Errors: one ErrorKind::syntax error for text that is not JSON (the detail says line and
/// column); otherwise every rule that the document breaks, and every limit that it exceeds with
/// `overrides` applied, each with its JSON Pointer.
Result<ViewedScene> read_viewed_scene(const DocumentText& text, const Limits& limits,
                                      const Overrides& overrides);

/// The view alone.
Result<Scene> read_scene(const DocumentText& text, const Limits& limits,
                         const Overrides& overrides = {});

}  // namespace raytracer
