// Faults inside OCCT come out as exceptions; signals that others send do not.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Standard_Failure.hxx>
#include <csignal>
#include <string>

#include "cad/occt.h"

namespace polycube {
namespace {

TEST(Occt, FaultsAreExceptionsThatOneCanRead) {
  std::string reason;
  try {
    // No null pointer: the sanitizers would tell of that themselves.
    void* const closed = mmap(nullptr, sizeof(int), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(closed, MAP_FAILED);
    catching_faults([&] { *static_cast<volatile int*>(closed) = 1; });
  } catch (const Standard_Failure& failure) {
    reason = reason_of(failure);
  }
  EXPECT_EQ(reason, "it runs into a fault of its own");
  EXPECT_EQ(reason_of(Standard_Failure("the fuse fails")), "the fuse fails");
  EXPECT_EQ(reason_of(Standard_Failure()), "Standard_Failure");
}

/// The signal that ends a process which is sent it while OCCT works; 0 where it goes on.
int end_of_a_process_sent(int signal) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit no_core{};
    setrlimit(RLIMIT_CORE, &no_core);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(fault, SIG_DFL);  // the sanitizers have theirs
    try {
      catching_faults([&] { kill(getpid(), signal); });
    } catch (const Standard_Failure&) {
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

TEST(Occt, SignalsThatAreSentAreNoFaultsOfAFile) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTERM}) EXPECT_EQ(end_of_a_process_sent(signal), signal);
}

}  // namespace
}  // namespace polycube
