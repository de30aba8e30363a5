#include "tests/measure/cluster/nats.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "tests/process/patience.h"

namespace raytracer::measure {

double processor_ms(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string text((std::istreambuf_iterator<char>(file)), {});
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) * 1000 / static_cast<double>(sysconf(_SC_CLK_TCK));
}

Nats::Nats()
    : process_(
          {"nats-server", {"-js", "-sd", folder_.path().string(), "-a", "127.0.0.1", "-p", "-1"}}) {
  static const std::regex greeting(R"(client connections on 127.0.0.1:(\d+))");
  test::eventually([this] {
    std::smatch match;
    const std::string said = process_.err();
    if (std::regex_search(said, match, greeting)) url_ = "nats://127.0.0.1:" + match.str(1);
    return !url_.empty() || process_.wait({}).has_value();
  });
  if (url_.empty())
    throw std::runtime_error("nats-server does not start (.ci/install cluster): " + process_.err());
}

}  // namespace raytracer::measure
