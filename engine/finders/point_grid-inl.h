// A packet's shadow rays to a point light, by the cube of grids around the light.

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The cells in which the directions `out` from the light leave its cube, for the lanes of `lit`,
/// at least one. Takes those out of `lit` that leave it where nothing is seen through it.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>,
          class Grid>
HWY_INLINE V cube_cells(D d, const Grid& grid, const V3<V>& out, M& lit) {
  const V zero = hn::Zero(d);
  const V3<V> size{hn::Abs(out.x), hn::Abs(out.y), hn::Abs(out.z)};
  const M is_x = hn::And(hn::Ge(size.x, size.y), hn::Ge(size.x, size.z));
  const M is_y = hn::Ge(size.y, size.z);
  const auto pick = [&](V x, V y, V z)
                        HWY_ATTR { return hn::IfThenElse(is_x, x, hn::IfThenElse(is_y, y, z)); };
  const V along = pick(out.x, out.y, out.z);
  const V scale = hn::Div(hn::Set(d, T(1)), hn::Abs(along));
  const V axis = pick(zero, hn::Set(d, T(2)), hn::Set(d, T(4)));
  const V face = hn::IfThenElse(hn::Lt(along, zero), hn::Add(axis, hn::Set(d, T(1))), axis);
  using Window = FaceWindow<T>;
  const Rows<D, Window> window(d, grid.windows.data(), face, lit);
  const auto place = [&](V across, V low, V cells_per_unit) HWY_ATTR {
    return hn::Floor(hn::Mul(hn::MulSub(across, scale, low), cells_per_unit));
  };
  const V column = place(pick(out.y, out.z, out.x), window(d, &Window::u_low),
                         window(d, &Window::columns_per_unit));
  const V row = place(pick(out.z, out.x, out.y), window(d, &Window::v_low),
                      window(d, &Window::rows_per_unit));
  const V side = hn::Set(d, static_cast<T>(grid.side));
  const V least = hn::Min(column, row);
  const V most = hn::Max(column, row);
  lit = hn::And(lit, hn::And(hn::Ge(least, zero), hn::Lt(most, side)));
  return hn::MulAdd(hn::MulAdd(face, side, row), side, column);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
