// The kinds of objects that pass over points of sweeps: those of the list of objects.h once more.

#include "engine/objects/sphere/sphere_sweep-inl.h"
