// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.hpp"

#include <csignal>

namespace cca::apps {
namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void remember(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
  interrupted = 0;
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

Interruption::~Interruption() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool Interruption::requested() const { return interrupted != 0; }

}  // namespace cca::apps
