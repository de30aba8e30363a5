// How the kinds of objects lie in packets of rays: the list of objects.h once more.
#pragma once

#include "engine/objects/cone/packets.h"
#include "engine/objects/cylinder/packets.h"
#include "engine/objects/lattice/packets.h"
#include "engine/objects/objects.h"
#include "engine/objects/packet_kind.h"
#include "engine/objects/plane/packets.h"
#include "engine/objects/sphere/packets.h"
#include "engine/objects/triangle/packets.h"

namespace raytracer {

static_assert(each_satisfies<ObjectKinds>([]<LaidOutKind Kind>(std::type_identity<Kind>) {}));

}  // namespace raytracer
