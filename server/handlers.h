// What each route does. A handler answers its call or throws HttpError; see routes.cpp for the
// table.
#pragma once

#include "server/call.h"
#include "server/embedded.h"
#include "server/services.h"

namespace raytracer {

/// The picture of a posted or named scene, while the client waits.
void post_or_get_render(Services& services, Call& call);

/// What the engine chose for a scene and why, with its prediction.
void post_plan(Services& services, Call& call);

/// Accepts a render or a trade-off to be fetched later: 202.
void post_job(Services& services, Call& call);
/// How far a job has come.
void get_job(Services& services, Call& call);
/// A render's picture: once it is done that, before as far as it has come.
void get_job_image(Services& services, Call& call);
/// A trade-off's curve.
void get_job_result(Services& services, Call& call);
/// A job's progress as server-sent events, up to its end.
void get_job_events(Services& services, Call& call);
/// Cancels and forgets a job.
void delete_job(Services& services, Call& call);

/// The shipped scenes, each with a line about it.
void get_scenes(Services& services, Call& call);
/// A shipped or kept scene's document.
void get_scene(Services& services, Call& call);
/// Keeps a scene under an id from its content: 201.
void post_scene(Services& services, Call& call);

/// Who works in the cluster, and on how much; 404 on a server that works alone.
void get_cluster(Services& services, Call& call);
/// That the process answers.
void get_health(Services& services, Call& call);
/// Whether new work is taken; 503 if not.
void get_readiness(Services& services, Call& call);
/// All metrics in Prometheus' text format.
void get_metrics(Services& services, Call& call);
/// Build, machine and the limits in force.
void get_version(Services& services, Call& call);
/// The JSON Schema of scene documents.
void get_scene_schema(Services& services, Call& call);
/// This service, described for programs.
void get_openapi(Services& services, Call& call);

/// One of the page's files, or 304 if the client has it.
void get_file(const EmbeddedFile& file, Call& call);

}  // namespace raytracer
