#include "engine/scene/error_list.h"

#include <fmt/format.h>

#include <utility>

namespace raytracer {

void ErrorList::add(ErrorKind kind, const Path& path, std::string detail) {
  ++count_;
  if (is_full()) return;
  const std::size_t bytes = path.pointer_size() + detail.size();
  if (bytes > most_bytes - bytes_) return;
  bytes_ += bytes;
  errors_.push_back({kind, path.pointer(), std::move(detail)});
}

std::vector<Error> ErrorList::take() && {
  if (count_ > errors_.size())
    errors_.push_back({ErrorKind::invalid, "",
                       fmt::format("and {} more errors, not listed", count_ - errors_.size())});
  return std::move(errors_);
}

}  // namespace raytracer
