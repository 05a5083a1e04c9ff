// What every call into OCCT's readers and long algorithms needs: silence, time limits, faults as exceptions.
#pragma once

#include <signal.h>

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Message_ProgressIndicator.hxx>
#include <OSD.hxx>
#include <OSD_Signal.hxx>
#include <Standard_ErrorHandler.hxx>
#include <array>
#include <iostream>
#include <mutex>
#include <string>

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

/// While it lives OCCT jumps from a segmentation fault of its own to the nearest OCC_CATCH_SIGNALS. A signal that another process sends, or this one to
/// itself, is no fault of what OCCT reads and goes to the process' own handlers, which come back for all afterwards.
class SignalGuard : OneAtATime<SignalGuard> {
 public:
  SignalGuard() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], nullptr, &before()[i]);
    OSD::SetSignal(Standard_False);
    for (std::size_t i = 0; i < kFaults; ++i) {
      struct sigaction only_faults {};
      only_faults.sa_sigaction = on_signal;
      only_faults.sa_flags = SA_SIGINFO;
      sigaction(kSignals[i], &only_faults, &occts()[i]);
    }
    // Interrupts stay with whoever handles them.
    for (std::size_t i = kFaults; i < kSignals.size(); ++i) sigaction(kSignals[i], &before()[i], nullptr);
  }
  ~SignalGuard() {
    for (std::size_t i = 0; i < kFaults; ++i) sigaction(kSignals[i], &before()[i], nullptr);
  }

 private:
  static constexpr std::size_t kFaults = 5;
  static constexpr std::array<int, 9> kSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGHUP, SIGINT, SIGQUIT, SIGTERM};
  using Actions = std::array<struct sigaction, kSignals.size()>;

  static Actions& before() {
    static Actions actions{};
    return actions;
  }
  static Actions& occts() {
    static Actions actions{};
    return actions;
  }
  static void on_signal(int signal, siginfo_t* what, void* context) {
    std::size_t i = 0;
    while (i + 1 < kFaults && kSignals[i] != signal) ++i;
    if (what->si_code <= 0) {  // sent, not raised by the processor
      sigaction(signal, &before()[i], nullptr);
      raise(signal);  // comes as soon as this handler has returned
    } else if ((occts()[i].sa_flags & SA_SIGINFO) != 0) {
      occts()[i].sa_sigaction(signal, what, context);
    } else {
      occts()[i].sa_handler(signal);
    }
  }
};

/// What a failure of OCCT's says, for the user.
inline std::string reason_of(const Standard_Failure& failure) {
  if (failure.IsKind(STANDARD_TYPE(OSD_Signal))) return "it runs into a fault of its own";
  const std::string text = failure.GetMessageString();
  return text.empty() ? failure.DynamicType()->Name() : text;
}

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
