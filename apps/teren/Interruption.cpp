#include "apps/teren/Interruption.h"

#include <array>
#include <atomic>
#include <csignal>

namespace teren {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP, SIGXFSZ};

// A worker thread may be the one that the signal interrupts.
std::atomic<bool> signalCame = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a handler may only set what needs no lock");
std::array<struct sigaction, kSignals.size()> formerActions;

void note(int) {
  signalCame = true;
}

}  // namespace

Interruption::Interruption() {
  signalCame = false;
  for (std::size_t k = 0; k < kSignals.size(); ++k) {
    sigaction(kSignals[k], nullptr, &formerActions[k]);
    if (formerActions[k].sa_handler == SIG_IGN) continue;  // nohup and the like mean it
    struct sigaction action {};
    action.sa_handler = kSignals[k] == SIGXFSZ ? SIG_IGN : &note;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(kSignals[k], &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (std::size_t k = 0; k < kSignals.size(); ++k) sigaction(kSignals[k], &formerActions[k], nullptr);
}

bool Interruption::came() const noexcept {
  return signalCame;
}

}  // namespace teren
