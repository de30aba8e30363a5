// A port for a program that cannot say which one it took, or needs the same one again.
#pragma once

namespace raytracer::test {

/// A port of the loopback that nobody listens on now; somebody else may take it first. Throws
/// std::runtime_error if there is none.
int free_port();

}  // namespace raytracer::test
