// How materials answer light, for packets of points. Effects that send rays on have no code here:
// those rays are followed (kernel/simd/followed_rays-inl.h).

#include "engine/materials/blinn_phong/blinn_phong-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// How the surfaces of a packet answer light.
template <class D>
using MaterialPacket = BlinnPhongPacket<D>;

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
