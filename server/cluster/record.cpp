#include "server/cluster/record.h"

#include <chrono>
#include <nlohmann/json.hpp>

namespace raytracer {
namespace {

/// One list of fields for both ways. Records of earlier builds lack those that were added.
template <typename Json, typename Record>
void each_field(Json& json, Record& record) {
  json.field("id", record.id);
  json.field("document", record.document);
  json.field("query", record.query);
  json.field("renderer", record.renderer);
  json.field("front", record.front);
  json.field("has_client", record.has_client);
  json.field("is_8_bit", record.is_8_bit);
  json.field("parse_ms", record.parse_ms);
  json.added("queue_ms", record.queue_ms);
  json.field("predicted_ms", record.predicted_ms);
  json.field("plan_ms", record.plan_ms);
  json.field("build_ms", record.build_ms);
  json.added("task_timeout_s", record.task_timeout_s);
  json.field("width", record.width);
  json.field("height", record.height);
  json.field("channels", record.channels);
  json.field("samples", record.samples);
  json.field("accepted_ms", record.accepted_ms);
  json.field("side_px", record.side_px);
  json.field("task_count", record.task_count);
  json.field("failure", record.failure);
  json.field("lacked_room", record.lacked_room);
}

struct JsonWriter {
  nlohmann::json json{};

  template <typename Value>
  void field(const char* name, const Value& value) {
    json[name] = value;
  }
  template <typename Value>
  void added(const char* name, const Value& value) {
    field(name, value);
  }
};

struct JsonReader {
  const nlohmann::json json;

  template <typename Value>
  void field(const char* name, Value& value) const {
    json.at(name).get_to(value);
  }
  template <typename Value>
  void added(const char* name, Value& value) const {
    if (json.contains(name)) field(name, value);
  }
};

}  // namespace

std::string to_text(const JobRecord& record) {
  JsonWriter writer;
  each_field(writer, record);
  nlohmann::json& json = writer.json;
  json["task"] = name_of(record.task);
  for (const LimitRow& row : limit_table) json["limits"][row.flag] = record.limits.*row.value;
  if (record.picture_digest) json["picture_digest"] = *record.picture_digest;
  // A reason may quote bytes that are no text.
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

JobRecord read_record(std::string_view text) try {
  const JsonReader reader{.json = nlohmann::json::parse(text)};
  JobRecord record;
  each_field(reader, record);
  const nlohmann::json& json = reader.json;
  record.task = json.at("task") == name_of(JobTask::tradeoff) ? JobTask::tradeoff : JobTask::render;
  if (json.contains("limits"))  // records of earlier builds have none
    for (const LimitRow& row : limit_table) record.limits.*row.value = json["limits"].at(row.flag);
  if (json.contains("picture_digest"))
    record.picture_digest = json["picture_digest"].get<std::string>();
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
