#include "server/answer.h"

#include <nlohmann/json.hpp>

namespace raytracer {
namespace {

/// httplib has no call for "close after this answer"; it closes after a content provider that
/// reports failure, which this one does once everything is written.
void set_closing_content(httplib::Response& response, std::string bytes,
                         const std::string& media_type) {
  response.set_header("Connection", "close");
  const std::size_t length = bytes.size();
  response.set_content_provider(
      length, media_type,
      [bytes = std::move(bytes)](std::size_t offset, std::size_t count, httplib::DataSink& sink) {
        sink.write(bytes.data() + offset, count);
        return false;
      });
}

}  // namespace

void answer_problem(httplib::Response& response, const Problem& problem,
                    ConnectionReuse afterwards) {
  for (const char* const of_success :
       {"Content-Type", "Content-Length", "ETag", "Vary", "Cache-Control", "Location"})
    response.headers.erase(of_success);
  response.body.clear();
  response.status = problem.status;
  for (const auto& [name, value] : problem.headers) response.set_header(name, value);
  const std::string media_type = "application/problem+json";
  if (afterwards == ConnectionReuse::close)
    set_closing_content(response, to_json(problem), media_type);
  else
    response.set_content(to_json(problem), media_type);
}

void answer_bytes(httplib::Response& response, std::string bytes, std::string_view media_type) {
  response.status = 200;
  response.body = std::move(bytes);
  response.set_header("Content-Type", std::string(media_type));
}

void answer_shared_bytes(httplib::Response& response, std::shared_ptr<const std::string> bytes,
                         std::string_view media_type) {
  constexpr std::size_t quickly_copied =
      16'384;  // httplib asks the socket more for what it is given
  if (bytes->size() <= quickly_copied) return answer_bytes(response, *bytes, media_type);
  response.status = 200;
  const std::size_t length = bytes->size();
  response.set_content_provider(
      length, std::string(media_type),
      [bytes = std::move(bytes)](std::size_t offset, std::size_t count, httplib::DataSink& sink) {
        return sink.write(bytes->data() + offset, count);
      });
}

void answer_json(httplib::Response& response, int status, const nlohmann::ordered_json& json) {
  answer_bytes(response, json.dump(2) + "\n", "application/json");
  response.status = status;
}

bool closes_connection(const httplib::Response& response) {
  return response.get_header_value("Connection") == "close";
}

}  // namespace raytracer
