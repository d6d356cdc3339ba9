// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace cca::apps {

/// Work that is done in the order in which it was given, in a thread of its own, while its giver
/// goes on. Whoever looks at its results waits first; so they do not depend on who was faster.
class BackgroundWork {
 public:
  BackgroundWork();
  /// Does what is left, and drops what it throws.
  ~BackgroundWork();
  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;

  /// Where a hundred pieces wait already it waits too. @throws what an earlier piece threw.
  void add(std::function<void()> work);
  /// Until all is done. @throws what a piece threw, the first of them; those after it are left out.
  void wait();

 private:
  void run();
  void raise();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool is_busy_ = false, ends_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace cca::apps
