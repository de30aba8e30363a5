// What the main function of a program that measures does.
#pragma once

#include <functional>
#include <future>
#include <iostream>
#include <optional>
#include <string>

namespace raytracer::measure {

/// Prints the report that measure() returns, unless parse() has the exit status already. Returns
/// the exit status: 1 where either throws, which is said with the program's name.
inline int print_measured(const std::string& program,
                          const std::function<std::optional<int>()>& parse,
                          const std::function<std::string()>& measure) {
  try {
    if (const auto status = parse()) return *status;
    // Not by the main thread: jemalloc 5.3 makes its arena before it has read the options, and
    // gives back its blocks of 8 MB at once; most of the server's threads have others.
    std::cout << std::async(std::launch::async, measure).get();
  } catch (const std::exception& error) {
    std::cerr << program << ": " << error.what() << '\n';
    return 1;
  }
  return 0;
}

}  // namespace raytracer::measure
