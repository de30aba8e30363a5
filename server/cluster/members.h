// Who of a cluster lives, and the signs of life of this one.
#pragma once

#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "server/cluster/store.h"

namespace raytracer {

/// How long ago it was heard of.
double silence_s(const Member& member);

/// Whether it was heard of lately.
bool is_alive(const Member& member, const StoreLimits& limits);

/// Whether somebody who was heard of lately takes tasks of this renderer.
bool has_worker(const std::vector<Member>& members, const std::string& renderer,
                const StoreLimits& limits);

/// Whether a server of this name was heard of lately.
bool lives(const std::vector<Member>& members, const std::string& name, const StoreLimits& limits);

/// Says that this server lives, several times within the tasks' timeout, until it ends; then that
/// it does not.
class SignsOfLife {
 public:
  /// `describe` is called each time, on another thread. Both must outlive it.
  SignsOfLife(ClusterStore& store, std::function<Member()> describe);
  ~SignsOfLife();
  SignsOfLife(const SignsOfLife&) = delete;
  SignsOfLife& operator=(const SignsOfLife&) = delete;

 private:
  void say_until_end(const std::stop_token& end);

  ClusterStore& store_;
  std::function<Member()> describe_;
  std::jthread thread_;
};

}  // namespace raytracer
