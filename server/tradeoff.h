// What is particular to jobs that measure a curve: what they refuse, and their result.
#pragma once

#include "engine/engine.h"
#include "server/job.h"
#include "server/query.h"

namespace raytracer {

/// How long a curve may take where its scene leaves a choice: as long as a person waits for one.
inline constexpr double most_curve_ms = 30'000;

/// The query to read the scene with: what a curve varies itself counts for nothing, in the document
/// and in the query alike. Throws HttpError 400 as read_query() does.
RenderQuery read_curve_query(const httplib::Params& params);

/// The query to read a job's scene with, whatever its task. Throws HttpError 400 as read_query()
/// does.
RenderQuery read_job_query(JobTask task, const httplib::Params& params);

/// Throws HttpError 422 if the query has values that no document of this scene could have, also of
/// what a curve varies itself.
void require_valid_settings(const httplib::Params& params, const Scene& scene);

/// Throws HttpError 413 if the shortest curve of this scene is more than the limits allow.
void require_room_for_curve(const Scene& scene, const Limits& limits);

/// The curve as GET /jobs/ID/result answers it.
CurveText text_of(const Curve& curve);

}  // namespace raytracer
