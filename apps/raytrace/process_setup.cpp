#include "process_setup.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

namespace raytrace {

namespace {

constexpr std::size_t main_stack = std::size_t{8} << 20U;     // as Linux gives it by default
constexpr std::size_t library_stack = std::size_t{1} << 20U;  // of which a few KiB are used

/// Each is replaced by a file that it cannot be used with: one that is opened the other way round, so that reading and
/// writing fail as they would have.
void occupy_standard_files() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(number, F_GETFD) >= 0 || errno != EBADF) continue;
    if (open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) open("/", O_PATH);
  }
}

/// By default each reserves as much as `ulimit -s` says, whether that is 16 KiB or 1 GiB.
void set_library_stacks() {
#if defined(__GLIBC__)
  pthread_attr_t attributes;
  if (pthread_getattr_default_np(&attributes) != 0) return;
  pthread_attr_setstacksize(&attributes, library_stack);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
#endif
}

/// The first thread's stack ends where `ulimit -s` says; that of another one can be larger.
void* run_to_the_end(void* program) { std::exit((*static_cast<const std::function<int()>*>(program))()); }

bool run_on_another_stack(const std::function<int()>& program) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, main_stack);
  pthread_t thread{};
  const int error =
      pthread_create(&thread, &attributes, run_to_the_end, const_cast<void*>(static_cast<const void*>(&program)));
  pthread_attr_destroy(&attributes);
  if (error != 0) return false;
  sigset_t all;  // handlers want a stack, too
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
  pthread_join(thread, nullptr);
  return true;
}

}  // namespace

int run_in_prepared_process(const std::function<int()>& program) {
  occupy_standard_files();
  for (const int number : {SIGPIPE, SIGXFSZ, SIGUSR1}) std::signal(number, SIG_IGN);
  set_library_stacks();
  rlimit stack{};
  const bool is_small = getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur < main_stack;
  if (is_small && run_on_another_stack(program)) return EXIT_FAILURE;  // never: the other thread ends the process
  return program();
}

}  // namespace raytrace
