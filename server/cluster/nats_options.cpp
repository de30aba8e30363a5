#include "server/cluster/nats_options.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "server/request_text.h"

namespace raytracer {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds longest_connect{2000};
constexpr milliseconds between_pings{2000};

/// libnats takes whatever it is given, and then tries for ever to connect to it.
bool is_nats_url(std::string_view url) {
  for (const std::string_view scheme : {"nats://", "tls://"}) {
    if (!url.starts_with(scheme)) continue;
    std::string_view host = url.substr(scheme.size());
    host.remove_prefix(host.find('@') + 1);  // 0 if there is none
    const std::size_t colon = host.find(':', host.starts_with('[') ? host.find(']') : 0);
    if (colon == host.npos) return !host.empty();
    const std::string_view port = host.substr(colon + 1);
    unsigned number = 0;
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
    return colon > 0 && error == std::errc{} && end == port.data() + port.size() && number > 0 &&
           number <= 65'535;
  }
  return false;
}

/// As a message shows it: without user and password, which logs must not have.
std::string without_credentials(std::string_view url) {
  const std::size_t at = url.rfind('@');
  if (at == url.npos) return std::string(url);
  const std::size_t scheme = url.find("://");
  const std::size_t begin = scheme < at ? scheme + 3 : 0;
  return fmt::format("{}...{}", url.substr(0, begin), url.substr(at));
}

/// Nothing if the variable names none.
const char* named_file(const char* variable) {
  const char* const file = std::getenv(variable);
  if (file != nullptr && !std::ifstream(file).is_open())
    throw std::invalid_argument(
        fmt::format("{} names a file that cannot be read: {}", variable, file));
  return file;
}

void set_credentials(natsOptions* options) {
  const auto require_use = [](natsStatus status, const char* variable) {
    if (status != NATS_OK)
      throw std::invalid_argument(fmt::format("{} names a file that cannot be used: {}", variable,
                                              nats_GetLastError(nullptr)));
  };
  if (const char* const file = named_file("NATS_CREDS"))
    require_use(natsOptions_SetUserCredentialsFromFiles(options, file, nullptr), "NATS_CREDS");
  if (const char* const file = named_file("NATS_CA"))
    require_use(natsOptions_LoadCATrustedCertificates(options, file), "NATS_CA");
  if (const char* const file = named_file("NATS_CERT"))
    require_use(natsOptions_LoadCertificatesChain(options, file, named_file("NATS_KEY")),
                "NATS_CERT or NATS_KEY");
}

}  // namespace

std::string nats_last_error() {
  natsStatus status{};
  const char* const said = nats_GetLastError(&status);
  std::string_view text = said != nullptr ? said : "";
  // It begins with a line of libnats' source: "(conn.c:2088): ".
  if (text.starts_with('('))
    if (const std::size_t end = text.find("): "); end != text.npos) text.remove_prefix(end + 3);
  return std::string(text);
}

std::string nats_place(const std::string& url) {
  std::string place;
  for (std::string_view part : parts_of(url, ',')) {
    if (const std::size_t scheme = part.find("://"); scheme != part.npos)
      part.remove_prefix(scheme + 3);
    part.remove_prefix(part.rfind('@') + 1);  // 0 if there is none
    place += (place.empty() ? "" : ", ") + std::string(part);
  }
  return place;
}

OptionsPointer nats_options(const std::string& url) {
  natsOptions* made = nullptr;
  if (natsOptions_Create(&made) != NATS_OK) throw std::bad_alloc();
  OptionsPointer options(made);
  std::vector<std::string> urls;
  for (const std::string_view part : parts_of(url, ',')) {
    if (!is_nats_url(part))
      throw std::invalid_argument(fmt::format(
          "--nats \"{}\" is no URL of NATS, such as nats://127.0.0.1:4222 or tls://host",
          without_credentials(part)));
    urls.emplace_back(part);
  }
  std::vector<const char*> servers;
  for (const std::string& one : urls) servers.push_back(one.c_str());
  if (natsOptions_SetServers(made, servers.data(), static_cast<int>(servers.size())) != NATS_OK)
    throw std::invalid_argument(fmt::format("--nats \"{}\" cannot be used: {}",
                                            without_credentials(url), nats_GetLastError(nullptr)));
  set_credentials(made);
  if (url.find("tls://") != std::string::npos) natsOptions_SetSecure(made, true);
  natsOptions_SetName(made, "raytracer");
  natsOptions_SetTimeout(made, longest_connect.count());
  natsOptions_SetPingInterval(made, between_pings.count());
  natsOptions_SetMaxPingsOut(made, 2);
  natsOptions_SetAllowReconnect(made, false);  // see NatsLink
  return options;
}

}  // namespace raytracer
