#include <signal.h>
#include <stddef.h>

/* Modules stay loaded, so that the sanitizer can name whose memory was not given back: those of Open MPI are gone by then. */
int dlclose(void* handle) {
  (void)handle;
  return 0;
}

/* Of clang's runtime; none in a program without it. */
int __lsan_do_recoverable_leak_check(void) __attribute__((weak));

static void tell_leaks(int signal) {
  (void)signal;
  if (__lsan_do_recoverable_leak_check != NULL) __lsan_do_recoverable_leak_check();
}

/* SIGUSR2: what has leaked so far is told. A job that is interrupted ends before the sanitizer looks. */
__attribute__((constructor)) static void tell_leaks_when_asked(void) {
  signal(SIGUSR2, tell_leaks);
}
