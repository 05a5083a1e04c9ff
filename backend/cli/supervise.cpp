#include "cli/supervise.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>
#include <thread>

#include "core/draft.h"
#include "core/faults.h"
#include "core/temporary_folder.h"

namespace polycube {
namespace {

// From the deadline to the end by force: what a child that notices the deadline needs to write what it has, within the 2 s that the
// contract gives.
constexpr auto kGrace = std::chrono::milliseconds(1500);
// Longer is not waited for a killed child to give its memory back; it runs no more.
constexpr auto kBurial = std::chrono::milliseconds(200);
constexpr auto kPoll = std::chrono::milliseconds(5);

volatile std::sig_atomic_t g_stops = 0;

extern "C" void on_stop(int) { g_stops = g_stops + 1; }

// From the keyboard, the terminal, a batch system, its limit of processor time, an alarm clock.
constexpr std::array kStops{SIGINT, SIGQUIT, SIGHUP, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGALRM};

/// Memory that the two processes share.
class SharedNote {
 public:
  SharedNote() : memory_(mmap(nullptr, sizeof(StageNote), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    note_ = new (memory_) StageNote;
  }
  SharedNote(const SharedNote&) = delete;
  SharedNote& operator=(const SharedNote&) = delete;
  ~SharedNote() { munmap(memory_, sizeof(StageNote)); }
  StageNote& get() { return *note_; }

 private:
  void* memory_;
  StageNote* note_ = nullptr;
};

void say(const char* why) { std::fprintf(stderr, "polycube: %s\n", why); }

[[noreturn]] void be_child(const std::function<int(StageNote&)>& work, StageNote& note, pid_t parent, const std::string& folder) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody waits for the mesh of a parent that was killed
  if (getppid() != parent) _exit(kStopped);
  if (g_stops > 0) {
    say("cancelled");
    _exit(kStopped);
  }
  // What ends the engine alone, such as its own limit of processor time, is not asked of the command.
  for (const int end : {SIGQUIT, SIGUSR1, SIGUSR2, SIGXCPU, SIGALRM}) std::signal(end, SIG_DFL);
  rlimit no_core{};
  getrlimit(RLIMIT_CORE, &no_core);
  no_core.rlim_cur = 0;
  setrlimit(RLIMIT_CORE, &no_core);
  setenv("TMPDIR", folder.c_str(), 1);
  end_by_faults();
  std::exit(work(note));
}

/// Waits for the child; forwards what stops it. True where it had to be killed.
bool await(pid_t child, Monitor::Clock::time_point deadline, int& status) {
  using Clock = Monitor::Clock;
  Clock::time_point end = deadline == Clock::time_point::max() ? deadline : deadline + kGrace;
  std::optional<Clock::time_point> killed;
  bool forwarded = false;
  for (;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return killed.has_value();
    if ((ended < 0 && errno != EINTR) || (killed && Clock::now() > *killed + kBurial)) return true;
    if (g_stops > 0 && !forwarded) {
      kill(child, SIGTERM);
      forwarded = true;
      end = std::min(end, Clock::now() + kGrace);
    }
    if (!killed && (g_stops > 1 || Clock::now() > end)) {
      kill(child, SIGKILL);
      killed = Clock::now();
    }
    std::this_thread::sleep_for(kPoll);
  }
}

}  // namespace

void StageNote::set(const std::string& stage) {
  for (std::size_t i = 0; i < kLength; ++i) text_[i] = i < std::min(stage.size(), kLength - 1) ? stage[i] : '\0';
}

std::string StageNote::get() const {
  std::string text;
  for (std::size_t i = 0; i < kLength && text_[i] != '\0'; ++i) text += text_[i];
  return text;
}

void watch_for_stops() {
  std::signal(SIGPIPE, SIG_IGN);  // nobody has to read what is printed
  for (const int stop : kStops) {
    if (std::signal(stop, on_stop) == SIG_IGN && stop == SIGHUP) std::signal(stop, SIG_IGN);  // under nohup
  }
}

int supervise(const std::function<int(StageNote&)>& work, const Supervision& supervision) {
  watch_for_stops();
  const TemporaryFolder folder;
  SharedNote note;
  std::fflush(nullptr);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::runtime_error(std::string("no process for the engine: ") + std::strerror(errno));
  if (child == 0) be_child(work, note.get(), parent, folder.path());
  int status = 0;
  const bool killed = await(child, supervision.deadline, status);
  if (!killed && WIFEXITED(status)) return WEXITSTATUS(status);

  for (const std::string& output : supervision.outputs) Draft::discard(output, child);
  if (isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
  if (killed || g_stops > 0) {
    say(g_stops > 0 ? "cancelled" : "out of time");
    return kStopped;
  }
  const std::string stage = note.get().get();
  const int signal = WTERMSIG(status);
  std::fprintf(stderr, "polycube: stage %s: the engine ended by signal %d (%s)%s\n", stage.empty() ? "start" : stage.c_str(), signal, strsignal(signal),
               signal == SIGKILL ? ", perhaps for want of memory" : "");
  return kFailed;
}

}  // namespace polycube
