#include "engine/parallel/processors.h"

#ifdef __linux__
#include <sched.h>
#endif

namespace raytracer {

#ifdef __linux__

int current_processor() { return sched_getcpu(); }

void leave_processors(const std::vector<int>& busy) {
  cpu_set_t allowed;
  // Fails on a machine of more than 1,024 processors; they have others that are idle.
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  cpu_set_t others = allowed;
  for (const int processor : busy) CPU_CLR(static_cast<unsigned>(processor), &others);
  if (CPU_COUNT(&others) == 0 || sched_setaffinity(0, sizeof others, &others) != 0) return;
  sched_setaffinity(0, sizeof allowed, &allowed);
}

#else

int current_processor() { return -1; }

void leave_processors(const std::vector<int>& /*busy*/) {}

#endif

}  // namespace raytracer
