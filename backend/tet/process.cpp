#include "tet/process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/error.h"
#include "tet/tuning.h"
#include "tet/worker/protocol.h"

extern char** environ;

namespace polycube {
namespace {

constexpr auto kPoll = std::chrono::milliseconds(10);

/// Kills and buries the child unless it has been buried.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (pid_ == 0) return;
    kill(pid_, SIGKILL);
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  /// Processor time so far, seconds.
  double worked() const {
    clockid_t clock;
    timespec time{};
    if (clock_getcpuclockid(pid_, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  bool ended(int& status) {
    const pid_t result = waitpid(pid_, &status, WNOHANG);
    if (result == 0 || (result < 0 && errno == EINTR)) return false;
    if (result < 0) status = 0x7f00;  // somebody else has taken the status: count it as a failure
    pid_ = 0;
    return true;
  }

 private:
  pid_t pid_;
};

pid_t spawn(const std::vector<std::string>& command, const std::string& error_file) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, error_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t pid = 0;
  const int error = posix_spawn(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot start " + command[0] + ": " + std::strerror(error));
  return pid;
}

std::string outcome(int status, const std::string& error_file) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  if (WIFEXITED(status) && WEXITSTATUS(status) == kCannotWrite)
    throw StageFailed("tet", "the tetrahedra cannot be written: the folder for temporary files (TMPDIR) is full or must not grow");
  if (WIFSIGNALED(status)) return "Gmsh died of signal " + std::to_string(WTERMSIG(status));
  std::string line;
  std::ifstream in(error_file);
  std::string last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last.empty() ? "Gmsh failed without a word" : last;
}

}  // namespace

std::string find_worker() {
  if (const char* given = std::getenv("POLYCUBE_TET_WORKER")) return given;
  std::vector<std::filesystem::path> homes;
  std::error_code error;
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&find_worker), &info) && info.dli_fname)
    homes.push_back(std::filesystem::weakly_canonical(info.dli_fname, error).parent_path());
  homes.push_back(std::filesystem::read_symlink("/proc/self/exe", error).parent_path());
  // Beside it, and above it as in a build folder; then where it is installed, seen from bin, lib/TRIPLET and lib/python3/dist-packages.
  for (const std::filesystem::path& home : homes)
    for (const char* way : {".", "..", "../libexec/polycube", "../../libexec/polycube", "../../../libexec/polycube"})
      if (const std::filesystem::path worker = (home / way / "polycube-tet").lexically_normal(); access(worker.c_str(), X_OK) == 0) return worker.string();
  throw std::runtime_error("the program polycube-tet is missing");
}

std::string run_worker(const std::vector<std::string>& command, const std::string& error_file, double seconds, const Monitor& monitor) {
  const auto start = std::chrono::steady_clock::now();
  Child child(spawn(command, error_file));
  int status = 0;
  while (!child.ended(status)) {
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (child.worked() > seconds || elapsed > kTetTuning.patience * seconds) return "Gmsh ran longer than " + std::to_string(std::lround(seconds)) + " s";
    monitor.progress("tet", 0.9 * elapsed / (elapsed + 2));
    std::this_thread::sleep_for(kPoll);
  }
  return outcome(status, error_file);
}

}  // namespace polycube
