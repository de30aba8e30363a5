// Changes to what scenes share: each makes an array of its own.
#pragma once

#include <utility>
#include <vector>

#include "engine/memory/shared_array.h"

namespace raytracer::test {

/// Has change(values) change the array's values, a vector.
template <typename T, typename Change>
void edit(SharedArray<T>& array, const Change& change) {
  std::vector<T> values(array.begin(), array.end());
  change(values);
  array = std::move(values);
}

template <typename T>
void append(SharedArray<T>& array, T value) {
  edit(array, [&](std::vector<T>& values) { values.push_back(std::move(value)); });
}

}  // namespace raytracer::test
