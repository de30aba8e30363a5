// Which processor a thread runs on, and how it gets off one or leaves it to others.
//
// Linux takes a processor of a virtual machine that was idle for a while for one that is not there
// (vcpu_is_preempted, kernel/sched/fair.c), and wakes a thread on the processor of the one that
// wakes it: a render of 1 to 4 ms is over before it is moved, and took twice the time.
#pragma once

#include <vector>

namespace raytracer {

/// The number of the processor that runs this thread; -1 where the system does not say.
int current_processor();

/// Moves this thread to a processor that is not in `busy`, if there is one that the process's first
/// thread may run on, for the scheduler to leave it there or not. What this thread may run on is
/// then as for the first.
void leave_processors(const std::vector<int>& busy);

/// Whatever else has something to do gets this thread's processor at once and nearly all of its
/// time, from now on.
void run_in_background();

}  // namespace raytracer
