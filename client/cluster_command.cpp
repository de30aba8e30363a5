// raytracer cluster: who works behind a server that shares its work, a line for each.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/failure.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

using Row = std::vector<std::string>;

/// Columns as wide as their widest text, two blanks apart.
void print_table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) fmt::print("{:<{}}  ", row[i], widths[i]);
    fmt::print("{}\n", row.back());
  }
}

void print_cluster(const Cluster& cluster) {
  std::vector<Row> rows{{"worker", "build", "instructions", "threads", "tasks done", "last heard"}};
  for (const ClusterMember& member : cluster.members)
    rows.push_back({member.name, member.build, member.instruction_set,
                    std::to_string(member.threads),
                    member.works ? std::to_string(member.tasks_done) : "takes none",
                    fmt::format("{:.1f} s ago", member.last_heard_s)});
  print_table(rows);
  fmt::print("tasks: {} waiting, {} running, {} redelivered\n", cluster.tasks_waiting,
             cluster.tasks_running, cluster.redelivered);
}

}  // namespace

void add_cluster(CLI::App& app, const ServerChoice& server) {
  add_command(app, "cluster", "Show who works behind a server, and on how much")
      .callback([&server] {
        if (!with_variables(server).url)
          throw InputError(
              "cluster: name a server with --server or RAYTRACER_SERVER; a private one works "
              "alone");
        with_server(server, [](Api& api) { print_cluster(api.cluster()); });
      });
}

}  // namespace raytracer::client
