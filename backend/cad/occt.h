// What every call into OCCT's readers and long algorithms needs: silence, time limits, faults as exceptions.
#pragma once

#include <signal.h>

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Message_ProgressIndicator.hxx>
#include <OSD.hxx>
#include <Standard_ErrorHandler.hxx>
#include <array>
#include <iostream>
#include <mutex>

#include "core/error.h"
#include "core/monitor.h"

namespace polycube {

/// The base of guards of which only one of each kind may live at a time.
template <class Guard>
class OneAtATime {
 protected:
  OneAtATime() : lock_(mutex()) {}
  OneAtATime(const OneAtATime&) = delete;
  OneAtATime& operator=(const OneAtATime&) = delete;
  ~OneAtATime() = default;

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  std::lock_guard<std::mutex> lock_;
};

/// OCCT's readers keep settings and tables in globals, and some of them talk on std::cout: one at a time, in silence.
class ReaderGuard : OneAtATime<ReaderGuard> {
 public:
  ReaderGuard() : output_(std::cout.rdbuf(nullptr)) { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer)); }
  ~ReaderGuard() { std::cout.rdbuf(output_); }

 private:
  std::streambuf* output_;
};

/// While it lives OCCT jumps from a segmentation fault of its own to the nearest OCC_CATCH_SIGNALS. The process' own handlers come back afterwards.
class SignalGuard : OneAtATime<SignalGuard> {
 public:
  SignalGuard() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], nullptr, &before_[i]);
    OSD::SetSignal(Standard_False);
    // Interrupts stay with whoever handles them.
    for (std::size_t i = kFaults; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }
  ~SignalGuard() {
    for (std::size_t i = 0; i < kFaults; ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }

 private:
  static constexpr std::size_t kFaults = 5;
  static constexpr std::array<int, 9> kSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGHUP, SIGINT, SIGQUIT, SIGTERM};
  std::array<struct sigaction, 9> before_{};
};

/// Runs code of OCCT's. A fault in it, as references of the wrong kind in a damaged file give, comes out as a Standard_Failure. What the work itself
/// holds then is never destroyed: locks and the like must live outside.
template <class Work>
auto catching_faults(const Work& work) {
  const SignalGuard signals;
  OCC_CATCH_SIGNALS
  return work();
}

/// Ends OCCT's call that was given Start() of it as soon as the monitor wants a stop. What the call leaves then is not whole: ask monitor.check() next.
class OcctProgress : public Message_ProgressIndicator {
 public:
  explicit OcctProgress(const Monitor& monitor) : monitor_(monitor) {}
  Standard_Boolean UserBreak() override { return stopped(monitor_); }
  void Show(const Message_ProgressScope&, const Standard_Boolean) override {}

  static bool stopped(const Monitor& monitor) {
    try {
      monitor.check();
      return false;
    } catch (const Cancelled&) {
      return true;
    }
  }

 private:
  const Monitor& monitor_;
};

}  // namespace polycube
