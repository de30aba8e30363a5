#include "server/cluster/result.h"

#include <cstring>
#include <nlohmann/json.hpp>

#include "server/cluster/nats.h"

namespace raytracer {
namespace {

using Json = nlohmann::json;

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // clang 14 finds none by itself

template <typename Values>
void append(std::string& bytes, const Values& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()),
               values.size() * sizeof(values.front()));
}

void require_length(bool is_right) {
  if (!is_right) throw NatsRefused("a task's result is not as long as it says");
}

/// Takes `count` values off the front of `bytes`, which holds them.
template <typename Values>
void take(std::string_view& bytes, Values& values, std::size_t count) {
  require_length(count <= bytes.size() / sizeof(values.front()));
  values.resize(count);
  const std::size_t size = count * sizeof(values.front());
  if (size > 0) std::memcpy(values.data(), bytes.data(), size);
  bytes.remove_prefix(size);
}

Json to_json(const BeyondRange& beyond) { return {beyond.clamped, beyond.not_numbers}; }
BeyondRange beyond_in(const Json& json) { return {json.at(0), json.at(1)}; }

template <typename Channel>
Json header_of(const RegionRendering<Channel>& part) {
  const Tile& region = part.region;
  return {{"kind", sizeof(Channel) == 1 ? "bytes" : "floats"},
          {"region", {region.x_begin, region.y_begin, region.x_end, region.y_end}},
          {"values", part.values.size()},
          {"errors", part.subtile_error2.size()},
          {"error_multiplier", part.error_multiplier},
          {"precision", static_cast<int>(part.precision)},
          {"light_samples", part.light_samples},
          {"beyond", to_json(part.beyond)}};
}

Json header_of(const Rendering& rendering) {
  Json json{{"kind", "whole"},
            {"width", rendering.image.width},
            {"height", rendering.image.height},
            {"channels", rendering.image.channels},
            {"samples", rendering.samples_per_pixel},
            {"precision", static_cast<int>(rendering.precision)},
            {"light_samples", rendering.light_samples},
            {"beyond", to_json(rendering.beyond)},
            {"stop", static_cast<int>(rendering.stop)},
            {"plan_ms", rendering.plan_ms},
            {"build_ms", rendering.build_ms},
            {"trace_ms", rendering.trace_ms}};
  if (rendering.estimated_error) json["error"] = *rendering.estimated_error;
  return json;
}

Precision precision_in(const Json& header) {
  return static_cast<Precision>(header.at("precision").get<int>());
}

template <typename Channel>
RegionRendering<Channel> region_in(const Json& header, std::string_view bytes) {
  const Json& region = header.at("region");
  RegionRendering<Channel> part{.region = {region.at(0), region.at(1), region.at(2), region.at(3)},
                                .error_multiplier = header.at("error_multiplier"),
                                .precision = precision_in(header),
                                .light_samples = header.at("light_samples"),
                                .beyond = beyond_in(header.at("beyond"))};
  take(bytes, part.values, header.at("values"));
  take(bytes, part.subtile_error2, header.at("errors"));
  require_length(bytes.empty());
  return part;
}

Rendering whole_in(const Json& header, std::string_view bytes) {
  Rendering rendering;
  rendering.image.width = header.at("width");
  rendering.image.height = header.at("height");
  rendering.image.channels = header.at("channels");
  rendering.pixel_count = static_cast<std::size_t>(rendering.image.width) *
                          static_cast<std::size_t>(rendering.image.height);
  rendering.samples_per_pixel = header.at("samples");
  rendering.precision = precision_in(header);
  rendering.light_samples = header.at("light_samples");
  rendering.beyond = beyond_in(header.at("beyond"));
  rendering.stop = static_cast<Stop>(header.at("stop").get<int>());
  rendering.plan_ms = header.at("plan_ms");
  rendering.build_ms = header.at("build_ms");
  rendering.trace_ms = header.at("trace_ms");
  if (header.contains("error")) rendering.estimated_error = header["error"].get<double>();
  const Image& image = rendering.image;
  require_length(image.width >= 0 && image.height >= 0 &&
                 (image.channels == 3 || image.channels == 4));
  take(bytes, rendering.image.values, image.length_of(1) * rendering.pixel_count);
  require_length(bytes.empty());
  return rendering;
}

}  // namespace

std::string to_bytes(const TaskResult& result) {
  const auto with_header = [&](Json header) {
    header["worker"] = result.worker;
    return header.dump() + '\n';
  };
  const auto region = [&](const auto& part) {
    std::string bytes = with_header(header_of(part));
    append(bytes, part.values);
    append(bytes, part.subtile_error2);
    return bytes;
  };
  return std::visit(Overloaded{region,
                               [&](const Rendering& rendering) {
                                 std::string bytes = with_header(header_of(rendering));
                                 append(bytes, rendering.image.values);
                                 return bytes;
                               },
                               [&](const CurveText& curve) {
                                 return with_header({{"kind", "curve"}}) + curve.json;
                               }},
                    result.made);
}

TaskResult read_result(std::string_view bytes) try {
  const std::size_t end = bytes.find('\n');
  if (end == bytes.npos) throw NatsRefused("a task's result has no header");
  const Json header = Json::parse(bytes.substr(0, end));
  const std::string_view rest = bytes.substr(end + 1);
  const std::string kind = header.at("kind");
  const std::string worker = header.at("worker");
  if (kind == "bytes") return {worker, region_in<unsigned char>(header, rest)};
  if (kind == "floats") return {worker, region_in<float>(header, rest)};
  if (kind == "whole") return {worker, whole_in(header, rest)};
  if (kind == "curve") return {worker, CurveText{std::string(rest)}};
  throw NatsRefused("a task's result is of no known kind: " + kind);
} catch (const nlohmann::json::exception& error) {
  throw NatsRefused(std::string("a task's result cannot be read: ") + error.what());
}

}  // namespace raytracer
