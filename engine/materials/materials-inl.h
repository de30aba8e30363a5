// How materials answer light and bend rays, for packets. Where the rays go that they send on is in
// kernel/simd/trace_followed-inl.h.

#include "engine/materials/blinn_phong/blinn_phong-inl.h"
#include "engine/materials/glass/glass-inl.h"

namespace raytracer::HWY_NAMESPACE {

/// How the surfaces of a packet answer light.
template <class D>
using MaterialPacket = BlinnPhongPacket<D>;

}  // namespace raytracer::HWY_NAMESPACE
