#include "server/cluster/record.h"

#include <chrono>
#include <nlohmann/json.hpp>

namespace raytracer {

std::string to_text(const JobRecord& record) {
  nlohmann::json json{{"id", record.id},
                      {"task", name_of(record.task)},
                      {"document", record.document},
                      {"query", record.query},
                      {"renderer", record.renderer},
                      {"front", record.front},
                      {"has_client", record.has_client},
                      {"is_8_bit", record.is_8_bit},
                      {"parse_ms", record.parse_ms},
                      {"queue_ms", record.queue_ms},
                      {"predicted_ms", record.predicted_ms},
                      {"plan_ms", record.plan_ms},
                      {"build_ms", record.build_ms},
                      {"task_timeout_s", record.task_timeout_s},
                      {"width", record.width},
                      {"height", record.height},
                      {"channels", record.channels},
                      {"samples", record.samples},
                      {"accepted_ms", record.accepted_ms},
                      {"side_px", record.side_px},
                      {"task_count", record.task_count},
                      {"failure", record.failure},
                      {"lacked_room", record.lacked_room}};
  for (const LimitRow& row : limit_table) json["limits"][row.flag] = record.limits.*row.value;
  if (record.picture_digest) json["picture_digest"] = *record.picture_digest;
  // A reason may quote bytes that are no text.
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

JobRecord read_record(std::string_view text) try {
  const auto json = nlohmann::json::parse(text);
  JobRecord record{
      .id = json.at("id"),
      .task = json.at("task") == name_of(JobTask::tradeoff) ? JobTask::tradeoff : JobTask::render,
      .document = json.at("document"),
      .query = json.at("query"),
      .renderer = json.at("renderer"),
      .front = json.at("front"),
      .has_client = json.at("has_client"),
      .is_8_bit = json.at("is_8_bit"),
      .parse_ms = json.at("parse_ms"),
      .queue_ms = json.value("queue_ms", JobRecord{}.queue_ms),
      .predicted_ms = json.at("predicted_ms"),
      .plan_ms = json.at("plan_ms"),
      .build_ms = json.at("build_ms"),
      .task_timeout_s = json.value("task_timeout_s", JobRecord{}.task_timeout_s),
      .width = json.at("width"),
      .height = json.at("height"),
      .channels = json.at("channels"),
      .samples = json.at("samples"),
      .accepted_ms = json.at("accepted_ms"),
      .side_px = json.at("side_px"),
      .task_count = json.at("task_count"),
      .failure = json.at("failure"),
      .lacked_room = json.at("lacked_room")};
  if (json.contains("limits"))  // records of earlier builds have none
    for (const LimitRow& row : limit_table) record.limits.*row.value = json["limits"].at(row.flag);
  if (json.contains("picture_digest")) record.picture_digest = json["picture_digest"];
  return record;
} catch (const nlohmann::json::exception& error) {
  throw UnreadableRecord(std::string("a job's record cannot be read: ") + error.what());
}

std::int64_t now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace raytracer
