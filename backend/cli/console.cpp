#include "cli/console.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace polycube {
namespace {

volatile std::sig_atomic_t g_signalled = 0;

extern "C" void on_signal(int) { g_signalled = 1; }

}  // namespace

Console::Console(Monitor& monitor, StageNote& note, bool verbose)
    : note_(note), terminal_(isatty(STDERR_FILENO) != 0), verbose_(verbose), start_(Monitor::Clock::now()), last_(start_) {
  for (const int stop : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(stop, on_signal) == SIG_IGN && stop == SIGHUP) std::signal(stop, SIG_IGN);
  }
  monitor.cancel_requested = [] { return g_signalled != 0; };
  monitor.on_progress = [this](const std::string& stage, double fraction) { progress(stage, fraction); };
  if (verbose) monitor.on_log = [this](const std::string& line) { log(line); };
}

Console::~Console() { wipe(); }

void Console::progress(const std::string& stage, double fraction) {
  note_.set(stage);
  if (terminal_) show(stage, fraction);
}

void Console::show(const std::string& stage, double fraction) {
  const auto now = Monitor::Clock::now();
  if (shown_ && now - last_ < std::chrono::milliseconds(50)) return;
  last_ = now;
  shown_ = true;
  std::fprintf(stderr, "\r\033[K%s %.0f %%  %.0f s", stage.c_str(), 100 * fraction, std::chrono::duration<double>(now - start_).count());
  std::fflush(stderr);
}

void Console::log(const std::string& line) {
  wipe();
  std::fprintf(stderr, "[%8.2f s] %s\n", std::chrono::duration<double>(Monitor::Clock::now() - start_).count(), line.c_str());
}

void Console::wipe() {
  if (shown_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

}  // namespace polycube
