// A job that ends with the client, whichever way.
#pragma once

#include <functional>
#include <string>

#include "client/api.h"

namespace raytracer::client {

class OwnedJob {
 public:
  OwnedJob(Api& api, Job job) : api_(api), job_(std::move(job)) {}
  ~OwnedJob() { api_.delete_job(job_.id); }
  OwnedJob(const OwnedJob&) = delete;
  OwnedJob& operator=(const OwnedJob&) = delete;

  const std::string& id() const { return job_.id; }

  /// Whether it is done or never will be: then wait() returns or throws at once.
  bool has_ended();

  /// Returns when the job is done, with a bar in a terminal that says what it is `doing`.
  /// Throws ServerError if it never will be.
  void wait(const std::string& doing);
  /// The same with a bar that is there already: `show` is called again and again.
  void wait(const std::string& doing, const std::function<void(const Job&)>& show);

 private:
  Api& api_;
  Job job_;
};

}  // namespace raytracer::client
