// Items as packets try them: what kinds have in common of which each hit's normal is computed from
// its item, and whose shadows are looked for item by item.

#include <cstddef>

#include "engine/packets/primitive_row.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Calls visit(item, lanes) for the items that the lanes of `own` have hit, whose numbers are
/// `ids`.
template <class D, class Items, class Visit, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void for_each_item(D d, const PrimitiveRows<T>& rows, const Items& items, M own, V ids,
                              const Visit& visit) {
  alignas(64) T stored[hn::MaxLanes(D())];
  hn::Store(ids, d, stored);
  while (!hn::AllFalse(d, own)) {
    const T id = stored[hn::FindFirstTrue(d, own)];
    const M here = hn::And(own, hn::Eq(ids, hn::Set(d, id)));
    own = hn::AndNot(here, own);
    const auto index = static_cast<std::size_t>(rows[static_cast<std::size_t>(id)].item);
    if (index < items.size() && items[index].id == id) visit(items[index], here);
  }
}

/// Sets the normals of the lanes of `own` that hit one of the items: normals(item).
template <class D, class Items, class Normals, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void set_item_normals(D d, const PrimitiveRows<T>& rows, const Items& items, M own,
                                 RayOrigin<V>& at, const Normals& normals) {
  for_each_item(d, rows, items, own, at.id, [&](const auto& item, M here) HWY_ATTR {
    at.normal = select(here, normals(item), at.normal);
  });
}

/// Lanes of `lit` that one of so many items hides from a light: hides(index, lanes, hidden) says
/// whether it hides any of lanes, and which.
template <class D, class Hides, class M = hn::Mask<D>>
HWY_INLINE M occluded_by_items(D d, std::size_t count, M lit, const Hides& hides) {
  M dark = hn::Lt(hn::Zero(d), hn::Zero(d));
  for (std::size_t i = 0; i < count; ++i) {
    M hidden = lit;
    if (hides(i, lit, hidden)) dark = hn::Or(dark, hidden);
  }
  return dark;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
