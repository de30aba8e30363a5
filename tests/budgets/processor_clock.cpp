// The clock that never jumps, in this program: it goes while the program has a processor and stands
// still while something else has it. To what the program times, a busy machine is an idle one.
//
// Limits: work of one thread; several threads' times are added. On other systems than Linux it is
// the machine's clock.
#ifdef __linux__
#include <sys/syscall.h>
#include <unistd.h>

#include <ctime>

// In place of the C library's, which std::chrono::steady_clock asks.
extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const clockid_t asked = clock == CLOCK_MONOTONIC ? CLOCK_PROCESS_CPUTIME_ID : clock;
  return static_cast<int>(syscall(SYS_clock_gettime, asked, time));
}
#endif
