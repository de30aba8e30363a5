#include "server/cluster/prepared_scenes.h"

#include <utility>

#include "server/query.h"
#include "server/tradeoff.h"

namespace raytracer {
namespace {

/// Structures take some times the memory of what they are made of.
constexpr std::size_t structure_factor = 3;

Overrides overrides_of(const JobRecord& record) {
  const httplib::Params params(record.query.begin(), record.query.end());
  const bool is_curve = record.task == JobTask::tradeoff;
  return (is_curve ? read_curve_query(params) : read_query(params)).overrides;
}

std::string key_of(const JobRecord& record) {
  std::string key = record.document;
  for (const auto& [name, text] : record.query)
    key.append("&").append(name).append("=").append(text);
  return key;
}

}  // namespace

SceneView PreparedScenes::view_of(const JobRecord& record) {
  const std::scoped_lock lock(reading_);
  if (auto known = read_.find(record.document))
    return Scenes::view(std::move(known), overrides_of(record), record.limits);
  const std::string text = store_.document(record.document);
  metrics_.add("cluster_scene_bytes_total", static_cast<double>(text.size()));
  SceneView view = scenes_.read(text, overrides_of(record), record.limits);
  read_.keep(record.document, view.known, memory_bytes(view.known->scene) + text.size());
  return view;
}

std::shared_ptr<const PreparedView> PreparedScenes::prepare(const JobRecord& record) {
  const std::scoped_lock lock(preparing_);
  const std::string key = key_of(record);
  if (auto kept = prepared_.find(key)) return kept;
  SceneView view = view_of(record);
  const std::size_t bytes = structure_factor * memory_bytes(view.scene) + sizeof(PreparedView);
  const auto made = std::make_shared<const PreparedView>(std::move(view), pool_);
  prepared_.keep(key, made, bytes);
  return made;
}

}  // namespace raytracer
