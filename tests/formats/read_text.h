// A text read as a file of some format.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/formats/format.h"

namespace raytracer::test {

/// All frames of it. Throws InputError as the reader does.
inline std::vector<client::Reading> read_text(const client::Format& format, const std::string& text,
                                              const client::ImportOptions& options = {}) {
  const auto file = format.open({client::source_of_text(text), ""}, options);
  std::vector<client::Reading> frames;
  while (auto frame = file->next_frame()) frames.push_back(std::move(*frame));
  return frames;
}

/// The documents of all frames of a file with this ending; throws if it has errors.
inline std::vector<nlohmann::json> documents(const std::string& ending, const std::string& text,
                                             const client::ImportOptions& options = {}) {
  std::vector<nlohmann::json> result;
  for (const client::Reading& frame : read_text(*client::format_of(ending), text, options)) {
    if (!frame.errors.empty()) throw std::runtime_error(frame.errors.front().what);
    result.push_back(nlohmann::json::parse(client::model::to_document(frame.scene)));
  }
  return result;
}

/// That of the first one.
inline nlohmann::json document(const std::string& ending, const std::string& text,
                               const client::ImportOptions& options = {}) {
  return documents(ending, text, options).at(0);
}

}  // namespace raytracer::test
