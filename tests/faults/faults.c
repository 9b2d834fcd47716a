/* Makes calls of a program fail, or stops it in one: LD_PRELOAD of the tests of reliability.

   TETHER_FAULT=PROGRAM:CALL:PART:N:ACTION
     PROGRAM  as the kernel names it; CALL one of open (for writing), write, rename, mkdir, sync; PART of the file's path (-: any);
     N        the first matching call that is meant, from 1
     ACTION   ENOSPC, EDQUOT, EIO, EACCES, EROFS: this call fails, and all matching ones after it;
              KILL, TERM, INT, STOP: the program gets this signal;
              PAUSE: it makes the file TETHER_FAULT_FLAG and waits until that is gone, two minutes at most;
              none waits where FLAG.over is
   TETHER_FAULT_ROOT: the folder whose files are meant.
   TETHER_FAULT_LOG: a file that gets a line "PROGRAM CALL PATH" for each of these calls.
   TETHER_FAULT_CLOCK: by so many seconds the time of day jumps, in each process two seconds after its start. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static int seen = 0;

static int error_number(const char* name) {
  static const struct {
    const char* name;
    int number;
  } all[] = {{"ENOSPC", ENOSPC}, {"EDQUOT", EDQUOT}, {"EIO", EIO}, {"EACCES", EACCES}, {"EROFS", EROFS}};
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
    if (strcmp(name, all[i].name) == 0) return all[i].number;
  return 0;
}

static int signal_number(const char* name) {
  static const struct {
    const char* name;
    int number;
  } all[] = {{"KILL", SIGKILL}, {"TERM", SIGTERM}, {"INT", SIGINT}, {"STOP", SIGSTOP}};
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
    if (strcmp(name, all[i].name) == 0) return all[i].number;
  return 0;
}

static void append_line(const char* file, const char* call, const char* path) {
  char line[PATH_MAX + 64];
  const int length = snprintf(line, sizeof line, "%s %s %s\n", program_invocation_short_name, call, path);
  const int descriptor = (int)syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND, 0644);
  if (descriptor < 0) return;
  if (syscall(SYS_write, descriptor, line, (size_t)length) < 0) abort();
  syscall(SYS_close, descriptor);
}

/* Until the flag is gone; FLAG.over: programs that come later do not wait any more. */
static void wait_while(const char* flag) {
  char over[PATH_MAX];
  snprintf(over, sizeof over, "%s.over", flag);
  if (access(over, F_OK) == 0) return;
  const int descriptor = (int)syscall(SYS_openat, AT_FDCWD, flag, O_WRONLY | O_CREAT, 0644);
  if (descriptor >= 0) syscall(SYS_close, descriptor);
  for (int i = 0; i < 12000 && access(flag, F_OK) == 0; ++i) usleep(10000);
}

/* What a call on a path is to fail with; 0: it is not to fail. */
static int fault_of(const char* call, const char* path) {
  const char *root = getenv("TETHER_FAULT_ROOT"), *given = getenv("TETHER_FAULT"), *log = getenv("TETHER_FAULT_LOG");
  char whole[PATH_MAX];
  if (root == NULL) return 0;
  if (path[0] != '/') {
    char folder[PATH_MAX];
    if (getcwd(folder, sizeof folder) == NULL) return 0;
    snprintf(whole, sizeof whole, "%.2000s/%.2000s", folder, path);
    path = whole;
  }
  if (strncmp(path, root, strlen(root)) != 0) return 0;
  if (log != NULL) append_line(log, call, path);
  if (given == NULL) return 0;
  char program[32], which[16], part[256], action[16];
  int n = 0;
  if (sscanf(given, "%31[^:]:%15[^:]:%255[^:]:%d:%15s", program, which, part, &n, action) != 5) abort();
  if (strcmp(program, program_invocation_short_name) != 0 || strcmp(which, call) != 0 ||
      (strcmp(part, "-") != 0 && strstr(path + strlen(root), part) == NULL) || ++seen < n)
    return 0;
  if (error_number(action) != 0) return error_number(action);
  if (seen > n) return 0;
  if (strcmp(action, "PAUSE") == 0) wait_while(getenv("TETHER_FAULT_FLAG"));
  else raise(signal_number(action));
  return 0;
}

static int fails(const char* call, const char* path) {
  const int before = errno, number = fault_of(call, path);
  errno = number != 0 ? number : before;
  return number != 0;
}

static int fails_on(const char* call, int descriptor) {
  char link[64], path[PATH_MAX];
  const int before = errno;
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  errno = before;
  if (length <= 0 || path[0] != '/') return 0;
  path[length] = '\0';
  return fails(call, path);
}

static int is_writing(int flags) { return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0; }
static int is_writing_mode(const char* mode) { return strpbrk(mode, "wa+") != NULL; }

static int mode_in(int flags, va_list arguments) { return (flags & O_CREAT) != 0 ? va_arg(arguments, int) : 0; }

#define OPENS(name)                                              \
  int name(const char* path, int flags, ...) {                   \
    va_list arguments;                                           \
    va_start(arguments, flags);                                  \
    const int mode = mode_in(flags, arguments);                  \
    va_end(arguments);                                           \
    if (is_writing(flags) && fails("open", path)) return -1;     \
    return REAL(name)(path, flags, mode);                        \
  }
OPENS(open)
OPENS(open64)

#define OPENS_AT(name)                                                   \
  int name(int folder, const char* path, int flags, ...) {               \
    va_list arguments;                                                   \
    va_start(arguments, flags);                                          \
    const int mode = mode_in(flags, arguments);                          \
    va_end(arguments);                                                   \
    if (folder == AT_FDCWD && is_writing(flags) && fails("open", path)) return -1; \
    return REAL(name)(folder, path, flags, mode);                        \
  }
OPENS_AT(openat)
OPENS_AT(openat64)

FILE* fopen(const char* path, const char* mode) {
  return is_writing_mode(mode) && fails("open", path) ? NULL : REAL(fopen)(path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  return is_writing_mode(mode) && fails("open", path) ? NULL : REAL(fopen64)(path, mode);
}
ssize_t write(int descriptor, const void* data, size_t size) {
  return fails_on("write", descriptor) ? -1 : REAL(write)(descriptor, data, size);
}
ssize_t writev(int descriptor, const struct iovec* pieces, int count) {
  return fails_on("write", descriptor) ? -1 : REAL(writev)(descriptor, pieces, count);
}
size_t fwrite(const void* data, size_t size, size_t count, FILE* file) {
  return fails_on("write", fileno(file)) ? 0 : REAL(fwrite)(data, size, count, file);
}
int rename(const char* from, const char* to) { return fails("rename", to) ? -1 : REAL(rename)(from, to); }
int mkdir(const char* path, mode_t mode) { return fails("mkdir", path) ? -1 : REAL(mkdir)(path, mode); }
int fsync(int descriptor) { return fails_on("sync", descriptor) ? -1 : REAL(fsync)(descriptor); }

/* By how much the time of day is wrong by now [s]. */
static time_t jump(void) {
  static time_t begin = 0;
  const char* given = getenv("TETHER_FAULT_CLOCK");
  struct timespec now;
  if (given == NULL || syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &now) != 0) return 0;
  if (begin == 0) begin = now.tv_sec;
  return now.tv_sec >= begin + 2 ? atol(given) : 0;
}
__attribute__((constructor)) static void begin_clock(void) { jump(); }

int clock_gettime(clockid_t clock, struct timespec* value) {
  const int result = (int)syscall(SYS_clock_gettime, clock, value);
  if (result == 0 && clock == CLOCK_REALTIME) value->tv_sec += jump();
  return result;
}
int gettimeofday(struct timeval* restrict value, void* restrict zone) {
  struct timespec now;
  (void)zone;
  clock_gettime(CLOCK_REALTIME, &now);
  value->tv_sec = now.tv_sec;
  value->tv_usec = now.tv_nsec / 1000;
  return 0;
}
time_t time(time_t* value) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (value != NULL) *value = now.tv_sec;
  return now.tv_sec;
}
