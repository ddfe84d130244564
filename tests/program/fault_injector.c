// A disk that fails on demand, for tests: preloaded into the program it lets one kind of call on one kind of file fail
// or wait.
//   RAILSTRATA_FAULT="CALL NAME REASON SKIP"   the calls (open, write, fsync, rename) on files whose path contains NAME
//                                              fail with errno REASON, after SKIP that succeed;
//                                              REASON "wait": they take ten seconds instead; "term": the first one
//                                              is made, after a SIGTERM to this process. A write that fails for
//                                              lack of room has written half of its bytes before, as on a real disk.
//   RAILSTRATA_HOST="north"                    the name of the machine that the program sees
//   RAILSTRATA_CLOCK="-600"                    its clock is so many seconds ahead; that of the file system is not
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

// errno of the fault that this call is to have; 0: none.
static int fault(const char* call, const char* path) {
  static int skipped = 0;
  char wanted[16], name[128], reason[16];
  int skip = 0;
  const char* text = getenv("RAILSTRATA_FAULT");
  if (!text || sscanf(text, "%15s %127s %15s %d", wanted, name, reason, &skip) < 3) return 0;
  if (strcmp(wanted, call) != 0 || !strstr(path, name) || skipped++ < skip) return 0;
  if (strcmp(reason, "term") == 0) {
    if (skipped == skip + 1) kill(getpid(), SIGTERM);
    return 0;
  }
  if (strcmp(reason, "wait") != 0) return atoi(reason);
  for (int tenths = 0; tenths < 100; ++tenths) usleep(100000);
  return 0;
}

static int fault_on(const char* call, int descriptor) {
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t n = readlink(link, path, sizeof path - 1);
  if (n < 0) return 0;
  path[n] = '\0';
  return fault(call, path);
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  const int reason = flags & (O_WRONLY | O_RDWR) ? fault("open", path) : 0;
  if (!reason) return REAL(open)(path, flags, mode);
  errno = reason;
  return -1;
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  static int half_done = 0;
  const int reason = fault_on("write", descriptor);
  if (!reason) return REAL(write)(descriptor, bytes, count);
  if (reason == ENOSPC && !half_done && count > 1) {
    half_done = 1;
    return REAL(write)(descriptor, bytes, count / 2);
  }
  errno = reason;
  return -1;
}

int fsync(int descriptor) {
  const int reason = fault_on("fsync", descriptor);
  if (!reason) return REAL(fsync)(descriptor);
  errno = reason;
  return -1;
}

int rename(const char* from, const char* to) {
  const int reason = fault("rename", to);
  if (!reason) return REAL(rename)(from, to);
  errno = reason;
  return -1;
}

int gethostname(char* name, size_t size) {
  const char* host = getenv("RAILSTRATA_HOST");
  if (!host) return REAL(gethostname)(name, size);
  snprintf(name, size, "%s", host);
  return 0;
}

static long ahead(void) {
  const char* seconds = getenv("RAILSTRATA_CLOCK");
  return seconds ? atol(seconds) : 0;
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  const int result = REAL(clock_gettime)(clock, now);
  if (result == 0 && clock == CLOCK_REALTIME) now->tv_sec += ahead();
  return result;
}

int gettimeofday(struct timeval* restrict now, void* restrict zone) {
  const int result = REAL(gettimeofday)(now, zone);
  if (result == 0) now->tv_sec += ahead();
  return result;
}

time_t time(time_t* now) {
  const time_t result = REAL(time)(NULL) + ahead();
  if (now) *now = result;
  return result;
}
