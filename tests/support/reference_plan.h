// Plans by other finders than the engine chose, and those of the reference.
#pragma once

#include "engine/plan/plan.h"

namespace raytracer::test {

inline void set(FinderRow& row, RayKind rays, Finder finder) {
  row[static_cast<std::size_t>(rays)] = finder;
}

/// A table by which rays of every kind find all kinds of bounded objects so.
inline FinderTable all_by(Finder finder) {
  FinderTable table{};
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    if constexpr (Kind::search == Search::bounded) table[kind_index<Kind>].fill(finder);
  });
  return table;
}

/// The same in the reference: one ray at a time, each primitive tried or by trees.
inline Plan reference_plan(Plan plan, Finder finder = Finder::one_by_one) {
  plan.kernel.value = Kernel::single_rays;
  plan.finders = all_by(finder);
  return plan;
}

}  // namespace raytracer::test
