// Work on large files by all of the machine's processors.
#pragma once

#include <cstddef>
#include <functional>

namespace raytracer::client {

/// How many threads are of use here: at least one.
std::size_t useful_threads();

/// Calls work(0) ... work(count - 1), each by a thread of its own, but the last and those for which
/// no thread can be had by this one. Returns when all have returned. Throws what one throws.
void in_threads(std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace raytracer::client
