// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "live_run.hpp"
#include "page_guard.hpp"

// Last, for it has the system define _res, a name that Eigen uses.
#include <httplib.h>

namespace cca {

/// What browsers are answered: GET / (the page), GET /events (the run as a stream of server-sent
/// events), POST /command. All is bounded: viewers, connections, sizes, times.
class PageServer {
 public:
  /// @throws std::runtime_error where it cannot listen there.
  PageServer(const LivePageSettings& settings, LiveRun& run);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  const std::string& url() const { return url_; }
  std::optional<RunCommand> nextCommand();

 private:
  void listen(const LivePageSettings& settings);
  void answer();
  void stream(httplib::Response& response);
  void command(const httplib::Request& request, httplib::Response& response);

  LiveRun& run_;
  const Eigen::Vector2d origin_;
  const bool has_robot_;
  const std::string page_;
  std::string url_;
  std::optional<PageGuard> guard_;
  std::atomic<int> viewers_{0};
  std::mutex mutex_;
  std::deque<RunCommand> commands_;
  std::shared_ptr<std::atomic<bool>> ends_;  ///< shared with the connections' queue
  httplib::Server server_;
  std::thread thread_;
};

}  // namespace cca
