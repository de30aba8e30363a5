// What each route does. A handler answers its call or throws HttpError; see routes.cpp for the
// table.
#pragma once

#include "server/call.h"
#include "server/embedded.h"
#include "server/services.h"

namespace raytracer {

void post_or_get_render(Services& services, Call& call);

void post_plan(Services& services, Call& call);

void post_job(Services& services, Call& call);
void get_job(Services& services, Call& call);
void get_job_image(Services& services, Call& call);
void get_job_result(Services& services, Call& call);
void get_job_events(Services& services, Call& call);
void delete_job(Services& services, Call& call);

void get_scenes(Services& services, Call& call);
void get_scene(Services& services, Call& call);
void post_scene(Services& services, Call& call);
void get_cluster(Services& services, Call& call);
void get_health(Services& services, Call& call);
void get_readiness(Services& services, Call& call);
void get_metrics(Services& services, Call& call);
void get_version(Services& services, Call& call);
void get_scene_schema(Services& services, Call& call);
void get_openapi(Services& services, Call& call);

/// One of the page's files, or 304 if the client has it.
void get_file(const EmbeddedFile& file, Call& call);

}  // namespace raytracer
