// The engine's one public header: text -> scene -> image -> bytes.
//
//   WorkerPool pool(2);
//   Result<Scene> scene = read_scene(text, Limits{});
//   RenderProgress progress;
//   Rendering rendering = render(scene.value(), Limits{}, pool, progress);
//   std::string png = encode(rendering.image, ImageFormat::png, pool);
//
// Everything is in namespace raytracer. Functions are pure unless they say otherwise; after a
// Scene exists nothing is expected to fail, and a broken invariant throws std::logic_error.
#pragma once

#include "engine/build_id.h"                // IWYU pragma: export
#include "engine/forecast/forecast.h"       // IWYU pragma: export
#include "engine/forecast/machine_costs.h"  // IWYU pragma: export
#include "engine/image/encode.h"            // IWYU pragma: export
#include "engine/image/image.h"             // IWYU pragma: export
#include "engine/kernel/this_machine.h"     // IWYU pragma: export
#include "engine/measure/processor.h"       // IWYU pragma: export
#include "engine/parallel/worker_pool.h"    // IWYU pragma: export
#include "engine/plan/explain.h"            // IWYU pragma: export
#include "engine/plan/machine.h"            // IWYU pragma: export
#include "engine/plan/sampling.h"           // IWYU pragma: export
#include "engine/render/prepared_scene.h"   // IWYU pragma: export
#include "engine/render/progress.h"         // IWYU pragma: export
#include "engine/render/region.h"           // IWYU pragma: export
#include "engine/render/render.h"           // IWYU pragma: export
#include "engine/scene/canonical.h"         // IWYU pragma: export
#include "engine/scene/document_text.h"     // IWYU pragma: export
#include "engine/scene/limits.h"            // IWYU pragma: export
#include "engine/scene/nearest_key.h"       // IWYU pragma: export
#include "engine/scene/overrides.h"         // IWYU pragma: export
#include "engine/scene/read_scene.h"        // IWYU pragma: export
#include "engine/scene/result.h"            // IWYU pragma: export
#include "engine/scene/scene.h"             // IWYU pragma: export
#include "engine/scene/scene_size.h"        // IWYU pragma: export
#include "engine/scene/schema.h"            // IWYU pragma: export
#include "engine/scene/work.h"              // IWYU pragma: export
#include "engine/tradeoff/curve.h"          // IWYU pragma: export
#include "engine/tradeoff/measure_curve.h"  // IWYU pragma: export
#include "engine/tradeoff/progress.h"       // IWYU pragma: export
