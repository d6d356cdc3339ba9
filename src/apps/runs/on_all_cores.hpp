// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <thread>
#include <vector>

namespace cca::apps {

/// A DoAll that gives each core that the process may use the next task as soon as it is free.
/// @throws what a task threw, when none is under way any more.
inline void doOnAllCores(int count, const std::function<void(int)>& task) {
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int k; (k = next++) < count;) task(k);
  };
  std::vector<std::future<void>> others;
  for (unsigned core = 1; core < std::thread::hardware_concurrency(); ++core) {
    others.push_back(std::async(std::launch::async, work));
  }
  work();
  for (auto& other : others) other.get();
}

}  // namespace cca::apps
