// The kinds of objects, each in a folder beside this file: the one list of them.
//
// To add one: its folder, its headers here, in packets.h and in objects-inl.h, and its name in
// ObjectKinds. The order is that in which messages and plans name them.
#pragma once

#include <cstddef>
#include <tuple>
#include <variant>

#include "engine/memory/page_allocator.h"
#include "engine/objects/cone/cone.h"
#include "engine/objects/cylinder/cylinder.h"
#include "engine/objects/kind.h"
#include "engine/objects/lattice/lattice.h"
#include "engine/objects/plane/plane.h"
#include "engine/objects/sphere/sphere.h"
#include "engine/objects/triangle/triangle.h"

namespace raytracer {

using ObjectKinds = Types<SphereKind, LatticeKind, PlaneKind, TriangleKind, CylinderKind, ConeKind>;
static_assert(each_satisfies<ObjectKinds>([]<ObjectKind Kind>(std::type_identity<Kind>) {
  each_satisfies<typename Kind::Documents>(
      []<ObjectDocument<typename Kind::Primitive> Document>(std::type_identity<Document>) {});
}));

/// What an object of a document is.
template <typename... Kind>
using DocumentsOf = typename Joined<typename Kind::Documents...>::All;
using ObjectDocuments = ObjectKinds::In<DocumentsOf>;
using Shape = ObjectDocuments::In<std::variant>;

/// A scene's primitives in frame coordinates, kind by kind.
template <typename... Kind>
using PrimitiveArrays = std::tuple<LargeArray<typename Kind::Primitive>...>;
using Primitives = ObjectKinds::In<PrimitiveArrays>;

template <class Kind>
constexpr std::size_t kind_index = ObjectKinds::index_of<Kind>();

template <class Kind>
const LargeArray<typename Kind::Primitive>& of_kind(const Primitives& primitives) {
  return std::get<kind_index<Kind>>(primitives);
}
template <class Kind>
LargeArray<typename Kind::Primitive>& of_kind(Primitives& primitives) {
  return std::get<kind_index<Kind>>(primitives);
}

/// The place among ObjectKinds of that to which a document's structure belongs.
constexpr std::size_t kind_of(const Shape& shape) {
  std::size_t kind = 0;
  std::size_t documents = 0;
  ObjectKinds::for_each([&]<class Kind>(std::type_identity<Kind>) {
    documents += Kind::Documents::count;
    kind += shape.index() >= documents ? 1 : 0;
  });
  return kind;
}

/// Calls visit(std::type_identity<Kind>()) for each kind of object.
template <typename Visit>
constexpr void for_each_kind(const Visit& visit) {
  ObjectKinds::for_each(visit);
}

}  // namespace raytracer
