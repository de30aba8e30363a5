// What the server says about itself: its health, its version, its schema, its page.
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/engine.h"
#include "server/answer.h"
#include "server/etag.h"
#include "server/handlers.h"
#include "server/request_text.h"

namespace raytracer {

namespace {

/// On one line and without its end, for probes that compare the whole.
void answer_status(Call& call, int status, std::string_view word) {
  answer_bytes(call.response, nlohmann::json{{"status", word}}.dump(), "application/json");
  call.response.status = status;
}

}  // namespace

void get_health(Services&, Call& call) { answer_status(call, 200, "ok"); }

void get_readiness(Services& services, Call& call) {
  if (services.admission.is_closing()) return answer_status(call, 503, "draining");
  if (services.admission.is_full()) return answer_status(call, 503, "full");
  // What needs nobody else goes on.
  const bool is_degraded = services.cluster && services.cluster->is_degraded();
  answer_status(call, 200, is_degraded ? "degraded" : "ok");
}

void get_version(Services& services, Call& call) {
  const Config& config = services.config;
  nlohmann::ordered_json limits = nlohmann::ordered_json::array();
  const auto add = [&](const auto& row, std::int64_t value) {
    limits.push_back({{"flag", row.flag},
                      {"variable", row.variable},
                      {"value", value},
                      {"meaning", row.meaning}});
  };
  for (const LimitRow& row : limit_table) add(row, config.limits.*row.value);
  for (const SizeRow& row : size_table) add(row, static_cast<std::int64_t>(config.*row.value));
  if (services.cluster)
    for (const SharedRow& row : shared_table) add(row, config.cluster.*row.value);
  answer_json(call.response, 200,
              {{"version", version},
               {"build_id", build_id},
               {"instruction_set", this_machine().instruction_set.name},
               {"threads", config.threads},
               {"renders_at_once", renders_at_once},
               {"limits", limits}});
}

void get_scene_schema(Services&, Call& call) {
  answer_bytes(call.response, scene_schema(), "application/schema+json");
}

void get_file(const EmbeddedFile& file, Call& call) {
  const std::string tag = entity_tag_of_bytes(file.bytes);
  // Weak: the bytes that are sent depend on what the client can decompress.
  call.response.set_header("ETag", "W/" + tag);
  // May be stored, but is to be asked for again: another version has other files.
  call.response.set_header("Cache-Control", "no-cache");
  if (matches_tag(header_list(call.request, "If-None-Match"), tag))
    call.response.status = 304;
  else
    answer_bytes(call.response, std::string(file.bytes), media_type_of(file.path));
}

}  // namespace raytracer
