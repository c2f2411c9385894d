/* For LD_PRELOAD: what a program takes for the time is its processor time and that of its ended children, as on a machine of its
   own. With one thread, that is; waiting for disks is not in it. */
#define _GNU_SOURCE
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

int clock_gettime(clockid_t clock, struct timespec* time) {
  if (clock != CLOCK_MONOTONIC) return (int)syscall(SYS_clock_gettime, clock, time);
  const int whose[] = {RUSAGE_SELF, RUSAGE_CHILDREN};
  long microseconds = 0;
  time->tv_sec = 1; /* a clock that shows nothing is taken for one that was not read */
  for (int i = 0; i < 2; ++i) {
    struct rusage used;
    getrusage(whose[i], &used);
    time->tv_sec += used.ru_utime.tv_sec + used.ru_stime.tv_sec;
    microseconds += used.ru_utime.tv_usec + used.ru_stime.tv_usec;
  }
  time->tv_sec += microseconds / 1000000;
  time->tv_nsec = microseconds % 1000000 * 1000;
  return 0;
}
