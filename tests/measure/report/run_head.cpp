#include "tests/measure/report/run_head.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/build_id.h"

namespace raytracer::measure {

std::string to_markdown(const RunHead& head, const std::string& title) {
  std::string text = fmt::format(
      "# {}, {}, commit {}\n\n"
      "- processor: {}, {} cores, {}; {} threads for everyone\n"
      "- system: {}; compiler: {}\n",
      title, head.date, head.commit, head.machine.processor, head.machine.cores,
      head.machine.vectors, head.thread_count, head.machine.system, head.machine.compiler);
  for (const auto& [name, version] : head.peers) text += fmt::format("- {} {}\n", name, version);
  return text + fmt::format("- command: `{}`\n\n", head.command);
}

nlohmann::ordered_json json_of(const RunHead& head) {
  nlohmann::ordered_json peers = nlohmann::ordered_json::object();
  for (const auto& [name, version] : head.peers) peers[name] = version;
  return {{"date", head.date},
          {"commit", head.commit},
          {"command", head.command},
          {"threads", head.thread_count},
          {"machine",
           {{"processor", head.machine.processor},
            {"cores", head.machine.cores},
            {"vectors", head.machine.vectors},
            {"system", head.machine.system},
            {"compiler", head.machine.compiler}}},
          {"engine", build_id},
          {"peers", std::move(peers)}};
}

double rounded(double ms) { return std::round(ms * 1e4) / 1e4; }

}  // namespace raytracer::measure
