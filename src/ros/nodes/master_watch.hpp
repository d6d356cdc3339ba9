// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <future>
#include <thread>

namespace cca {

/// Makes a node outlive its master: roscpp registers topics and services once, so a master that was
/// restarted would never hear of them. Connections between nodes need no master and are not
/// touched: a robot keeps hearing its commands meanwhile. Looks once a second, in a thread of its
/// own, for a master on another computer may take long to not answer.
class MasterWatch {
 public:
  MasterWatch();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

 private:
  void watch();

  std::promise<void> ending_;
  std::thread thread_;
};

}  // namespace cca
