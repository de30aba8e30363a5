// A packet's shadow rays to a point light, by the cube of grids around the light.

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The cells in which the directions `out` from the light leave its cube.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>,
          class Grid>
HWY_INLINE V cube_cells(D d, const Grid& grid, const V3<V>& out) {
  const V3<V> size{hn::Abs(out.x), hn::Abs(out.y), hn::Abs(out.z)};
  const M is_x = hn::And(hn::Ge(size.x, size.y), hn::Ge(size.x, size.z));
  const M is_y = hn::Ge(size.y, size.z);
  const auto pick = [&](V x, V y, V z)
                        HWY_ATTR { return hn::IfThenElse(is_x, x, hn::IfThenElse(is_y, y, z)); };
  const V along = pick(out.x, out.y, out.z);
  const V scale = hn::Div(hn::Set(d, T(0.5)), hn::Abs(along));
  const V side = hn::Set(d, static_cast<T>(grid.side));
  const V last = hn::Set(d, static_cast<T>(grid.side - 1));
  const auto place = [&](V across) HWY_ATTR {
    const V share = hn::MulAdd(across, scale, hn::Set(d, T(0.5)));
    return hn::Min(hn::Max(hn::Floor(hn::Mul(share, side)), hn::Zero(d)), last);
  };
  const V column = place(pick(out.y, out.z, out.x));
  const V row = place(pick(out.z, out.x, out.y));
  const V axis = pick(hn::Zero(d), hn::Set(d, T(2)), hn::Set(d, T(4)));
  const V face = hn::IfThenElse(hn::Lt(along, hn::Zero(d)), hn::Add(axis, hn::Set(d, T(1))), axis);
  return hn::MulAdd(hn::MulAdd(face, side, row), side, column);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
