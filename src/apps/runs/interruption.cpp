// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.hpp"

#include <csignal>
#include <cstdio>

namespace cca::apps {
namespace {

volatile std::sig_atomic_t interrupted = 0;
constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

extern "C" void remember(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
  interrupted = 0;
  for (const int signal : kSignals) {
    const bool ignored = std::signal(signal, remember) == SIG_IGN;
    if (ignored && signal == SIGHUP) std::signal(signal, SIG_IGN);  // nohup
  }
}

Interruption::~Interruption() {
  for (const int signal : kSignals) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

bool Interruption::requested() const { return interrupted != 0; }

void tellOfSaving() {
  std::fputs("cca-mrpt: interrupted; saving what was mapped, once more abandons it\n", stderr);
}

}  // namespace cca::apps
