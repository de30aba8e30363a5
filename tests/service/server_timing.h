// What an answer's Server-Timing says.
#pragma once

#include <httplib.h>

#include <limits>
#include <string>

namespace raytracer::test {

/// A stage's milliseconds; not a number if it is not among them.
inline double stage_ms(const httplib::Response& answer, const std::string& stage) {
  const std::string field = ", " + answer.get_header_value("Server-Timing");
  const std::string metric = ", " + stage + ";dur=";
  const std::size_t at = field.find(metric);
  if (at == std::string::npos) return std::numeric_limits<double>::quiet_NaN();
  return std::stod(field.substr(at + metric.size()));
}

/// "hit", "shared", or "" for an image that was made for this answer.
inline std::string cache_entry(const std::string& server_timing) {
  const std::string metric = "cache;desc=";
  const std::size_t at = server_timing.find(metric);
  if (at == std::string::npos) return "";
  const std::string rest = server_timing.substr(at + metric.size());
  return rest.substr(0, rest.find_first_of(",\r"));
}
inline std::string cache_entry(const httplib::Response& answer) {
  return cache_entry(answer.get_header_value("Server-Timing"));
}

}  // namespace raytracer::test
