// The kinds of objects for packets of rays: the list of objects.h once more. What is the same for
// surfaces of revolution stands around them: what they build on, and what builds on them.

// clang-format off
#include "engine/objects/axial-inl.h"
#include "engine/objects/cone/cone-inl.h"
#include "engine/objects/cone/surfaces-inl.h"
#include "engine/objects/cylinder/cylinder-inl.h"
#include "engine/objects/cylinder/surfaces-inl.h"
#include "engine/objects/axial_kinds-inl.h"
#include "engine/objects/axial_surfaces-inl.h"
#include "engine/objects/lattice/lattice-inl.h"
#include "engine/objects/plane/plane-inl.h"
#include "engine/objects/sphere/sphere-inl.h"
#include "engine/objects/triangle/triangle-inl.h"
// clang-format on
