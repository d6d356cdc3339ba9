// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cca::apps {

/// While one exists, Ctrl-C, SIGTERM and a terminal that is closed do not end the process but are
/// remembered, so that it can save what it has; a second one ends it at once. Afterwards they do
/// what they did before. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  bool requested() const;
};

/// Tells who interrupted a run what is going on, and what a second signal would do.
void tellOfSaving();

}  // namespace cca::apps
