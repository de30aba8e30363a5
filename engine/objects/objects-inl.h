// The kinds of objects for packets of rays: the list of objects.h once more.

#include "engine/objects/cone/cone-inl.h"
#include "engine/objects/cone/surfaces-inl.h"
#include "engine/objects/cylinder/cylinder-inl.h"
#include "engine/objects/cylinder/surfaces-inl.h"
#include "engine/objects/lattice/lattice-inl.h"
#include "engine/objects/plane/plane-inl.h"
#include "engine/objects/sphere/sphere-inl.h"
#include "engine/objects/triangle/triangle-inl.h"
