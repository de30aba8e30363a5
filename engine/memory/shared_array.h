// An array whose copies share its elements: a copy costs nothing, however large the array is.
//
// For values that are made once and read often. Whoever changes a copy that is shared first gets
// elements of its own, so no copy ever sees another's changes. Copies may be read on any number of
// threads; a single copy is changed by one thread at a time, as any value.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace raytracer {

template <typename T>
class SharedArray {
 public:
  using value_type = T;

  SharedArray() = default;
  SharedArray(std::vector<T> values)  // NOLINT: implicit, it is the same value
      : values_(std::make_shared<std::vector<T>>(std::move(values))) {}
  SharedArray(std::initializer_list<T> values) : SharedArray(std::vector<T>(values)) {}

  std::size_t size() const { return values_ ? values_->size() : 0; }
  bool empty() const { return size() == 0; }
  const T* begin() const { return values_ ? values_->data() : nullptr; }
  const T* end() const { return begin() + size(); }
  const T& operator[](std::size_t i) const { return (*values_)[i]; }
  /// Throws std::out_of_range if there is no such element.
  const T& at(std::size_t i) const {
    if (i >= size()) throw std::out_of_range("SharedArray::at");
    return (*values_)[i];
  }

  T& operator[](std::size_t i) { return own()[i]; }
  void push_back(T value) { own().push_back(std::move(value)); }
  void clear() { values_.reset(); }

 private:
  std::vector<T>& own() {
    if (!values_)
      values_ = std::make_shared<std::vector<T>>();
    else if (values_.use_count() > 1)
      values_ = std::make_shared<std::vector<T>>(*values_);
    return *values_;
  }

  std::shared_ptr<std::vector<T>> values_;  ///< null: empty
};

}  // namespace raytracer
