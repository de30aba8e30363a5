#include "engine/parallel/processors.h"

#include <algorithm>

#ifdef __linux__
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>
#elif defined(__APPLE__)
#include <pthread/qos.h>
#endif

namespace raytracer {

#ifdef __linux__

int current_processor() { return sched_getcpu(); }

void leave_processors(const std::vector<int>& busy) {
  cpu_set_t allowed;
  // The first thread's, which nobody narrows here: what this one may run on is fixed by being set,
  // and would not follow when the process gets other processors. Fails where there may be more than
  // 1,024; they have others that are idle.
  if (sched_getaffinity(getpid(), sizeof allowed, &allowed) != 0) return;
  cpu_set_t others = allowed;
  for (const int processor : busy) CPU_CLR(static_cast<unsigned>(processor), &others);
  if (CPU_COUNT(&others) == 0 || sched_setaffinity(0, sizeof others, &others) != 0) return;
  sched_setaffinity(0, sizeof allowed, &allowed);
}

// A tenth of the weight of others for a thread of Linux, whose threads have their own (nice(2),
// "C library/kernel differences"); anybody may lower it.
void run_in_background() {
  constexpr int lower = 10;
  constexpr int lowest = 19;
  setpriority(PRIO_PROCESS, 0, std::min(getpriority(PRIO_PROCESS, 0) + lower, lowest));
}

#else

int current_processor() { return -1; }

void leave_processors(const std::vector<int>& /*busy*/) {}

#ifdef __APPLE__
void run_in_background() { pthread_set_qos_class_self_np(QOS_CLASS_UTILITY, 0); }
#else
void run_in_background() {}
#endif

#endif

}  // namespace raytracer
