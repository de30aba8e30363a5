// Jobs that measurements give to a server, alone or of a cluster, and wait for.
#pragma once

#include <cstddef>
#include <string>

#include "tests/process/server_process.h"

namespace raytracer::measure {

/// Every function throws std::runtime_error, with what the server said, if it is not so before
/// long.

/// Returns when the front knows of so many servers that take tasks.
void await_workers(const test::ServerProcess& front, std::size_t count);

/// Returns when a task of the cluster is in work.
void await_running_task(const test::ServerProcess& front);

/// The job's path, "/jobs/ID".
std::string begin_job(const test::ServerProcess& server, const std::string& query);

/// Returns when the job is done.
void await_end(const test::ServerProcess& server, const std::string& job);

/// The body of an answer with status 200.
std::string get(const test::ServerProcess& server, const std::string& target);

}  // namespace raytracer::measure
