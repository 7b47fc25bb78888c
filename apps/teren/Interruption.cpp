#include "apps/teren/Interruption.h"

#include <array>
#include <csignal>

namespace teren {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP, SIGXFSZ};

volatile std::sig_atomic_t signalCame = 0;
std::array<struct sigaction, kSignals.size()> formerActions;

void note(int) {
  signalCame = 1;
}

}  // namespace

Interruption::Interruption() {
  signalCame = 0;
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
  return signalCame != 0;
}

}  // namespace teren
