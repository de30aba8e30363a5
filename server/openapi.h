// The service described for programs: OpenAPI 3.1.
//
// openapi.json says what is particular to each route, openapi.components.json what several share;
// what is the same for all is added here, so that it is said once: the request's id, the refusals
// that any request may meet, that refusals are problem+json, and the files of the page.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace raytracer {

/// The whole document.
nlohmann::ordered_json openapi_document();

}  // namespace raytracer
