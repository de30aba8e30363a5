// How materials answer light, for packets of points. Effects that send rays on have no code here:
// those rays are followed (kernel/simd/followed_rays-inl.h).

#if defined(RAYTRACER_MATERIALS_MATERIALS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_MATERIALS_MATERIALS_INL_H_
#undef RAYTRACER_MATERIALS_MATERIALS_INL_H_
#else
#define RAYTRACER_MATERIALS_MATERIALS_INL_H_
#endif

#include "engine/materials/blinn_phong/blinn_phong-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// How the surfaces of a packet answer light.
template <class D>
using MaterialPacket = BlinnPhongPacket<D>;

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
