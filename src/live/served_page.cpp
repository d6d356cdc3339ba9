// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>

#include "page_server.hpp"

namespace cca {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kEvery = std::chrono::milliseconds(50);  // an eye takes 20 Hz for motion
/// Lines are looked at twice a second, of a large map more seldom: for a fiftieth of the time.
constexpr auto kLinesEvery = std::chrono::milliseconds(500);
constexpr int kShareOfLines = 50;

class ServedPage : public LivePage {
 public:
  explicit ServedPage(const LivePageSettings& settings) : run_(settings), server_(settings, run_) {}

  bool isDue() const override { return Clock::now() - last_ >= kEvery; }
  void show(const RunView& view) override;
  const std::string& url() const override { return server_.url(); }
  void restart() override {
    LiveRun::Glimpse glimpse;
    glimpse.begins_anew = true;
    run_.hand(std::move(glimpse));
  }
  std::optional<RunCommand> nextCommand() override { return server_.nextCommand(); }
  void setPaused(bool is_paused) override { run_.setPaused(is_paused); }
  void finish(const std::vector<MapLine>& lines, const std::string& reason) override {
    run_.finish(lines, reason);
  }

 private:
  LiveRun run_;
  PageServer server_;
  Clock::time_point last_, next_lines_;
};

void ServedPage::show(const RunView& view) {
  last_ = Clock::now();
  LiveRun::Glimpse glimpse;
  glimpse.moment = view.moment;
  glimpse.scan = view.scan;
  glimpse.shown_at =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  if (last_ >= next_lines_) {
    glimpse.lines = view.map.lines();
    const auto now = Clock::now();
    next_lines_ = now + std::max<Clock::duration>(kLinesEvery, kShareOfLines * (now - last_));
  }
  run_.hand(std::move(glimpse));
}

}  // namespace
}  // namespace cca

extern "C" cca::LivePage* openServedPage(const cca::LivePageSettings& settings) {
  return new cca::ServedPage(settings);
}
