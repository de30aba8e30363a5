// The kinds of objects for packets of rays: the list of objects.h once more.

#if defined(RAYTRACER_OBJECTS_OBJECTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_OBJECTS_OBJECTS_INL_H_
#undef RAYTRACER_OBJECTS_OBJECTS_INL_H_
#else
#define RAYTRACER_OBJECTS_OBJECTS_INL_H_
#endif

#include "engine/objects/cylinder/cylinder-inl.h"
#include "engine/objects/lattice/lattice-inl.h"
#include "engine/objects/plane/plane-inl.h"
#include "engine/objects/sphere/sphere-inl.h"
#include "engine/objects/triangle/triangle-inl.h"

#endif  // include guard of each target
