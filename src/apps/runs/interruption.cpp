// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.hpp"

#include <csignal>
#include <cstdio>
#include <iterator>

namespace cca::apps {
namespace {

volatile std::sig_atomic_t interrupted = 0;
constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

struct sigaction before[std::size(kSignals)];

extern "C" void remember(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
  interrupted = 0;
  for (std::size_t k = 0; k < std::size(kSignals); ++k) {
    sigaction(kSignals[k], nullptr, &before[k]);
    const bool is_nohup = kSignals[k] == SIGHUP && before[k].sa_handler == SIG_IGN;
    if (!is_nohup) std::signal(kSignals[k], remember);
  }
}

Interruption::~Interruption() {
  for (std::size_t k = 0; k < std::size(kSignals); ++k) sigaction(kSignals[k], &before[k], nullptr);
}

bool Interruption::requested() const { return interrupted != 0; }

void tellOfSaving() {
  std::fputs("cca-mrpt: interrupted; saving what was mapped, once more abandons it\n", stderr);
}

}  // namespace cca::apps
