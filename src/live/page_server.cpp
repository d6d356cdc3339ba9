// SPDX-License-Identifier: BSD-3-Clause
#include "page_server.hpp"

#include <cmath>
#include <condition_variable>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace cca {
namespace {

constexpr int kMostViewers = 32;                    // a class before one robot; each holds a thread
constexpr std::size_t kThreads = kMostViewers + 8;  // the others answer all that is no stream
/// Open connections: far below the 1024 files that a program may have open by default, or the run
/// could not write its own.
constexpr std::size_t kMostConnections = 100;
constexpr std::size_t kLargestRequest = 4096;  // bytes
constexpr int kPatience = 2;                   // s, for the next bytes to come or go
constexpr std::size_t kMostCommands = 16;
constexpr double kFarthest = 2e7;  // m

/// Threads for as many connections as are allowed; others wait in the system's queue, which is
/// short and turns away the rest.
class BoundedConnections : public httplib::ThreadPool {
 public:
  explicit BoundedConnections(std::shared_ptr<std::atomic<bool>> ends)
      : httplib::ThreadPool(kThreads), ends_(std::move(ends)) {}

  void enqueue(std::function<void()> serve) override {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      while (open_ >= kMostConnections && !*ends_) {
        changed_.wait_for(lock, std::chrono::milliseconds(100));
      }
      ++open_;
    }
    httplib::ThreadPool::enqueue([this, serve = std::move(serve)] {
      serve();
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        --open_;
      }
      changed_.notify_one();
    });
  }

 private:
  std::shared_ptr<std::atomic<bool>> ends_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t open_ = 0;
};

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why + "\n", "text/plain; charset=utf-8");
}

std::optional<RunCommand> commandOf(const std::string& body) {
  const nlohmann::json asked = nlohmann::json::parse(body, nullptr, false);
  if (!asked.is_object() || !asked.contains("do") || !asked["do"].is_string()) return {};
  const std::string name = asked["do"];
  using Kind = RunCommand::Kind;
  const std::pair<const char*, Kind> known[] = {{"start", Kind::kStart},
                                                {"pause", Kind::kPause},
                                                {"stop", Kind::kStop},
                                                {"home", Kind::kHome},
                                                {"go", Kind::kGo}};
  for (const auto& [known_name, kind] : known) {
    if (name != known_name) continue;
    RunCommand command{kind};
    if (kind != Kind::kGo) return command;
    for (const char* key : {"x", "y"}) {
      if (!asked.contains(key) || !asked[key].is_number()) return {};
    }
    command.place_map = {asked["x"].get<double>(), asked["y"].get<double>()};
    if (!(command.place_map.cwiseAbs().maxCoeff() <= kFarthest)) return {};
    return command;
  }
  return {};
}

}  // namespace

PageServer::PageServer(const LivePageSettings& settings, LiveRun& run)
    : run_(run),
      origin_(settings.origin),
      has_robot_(settings.has_robot),
      page_(livePage()),
      ends_(std::make_shared<std::atomic<bool>>(false)) {
  server_.new_task_queue = [ends = ends_] { return new BoundedConnections(ends); };
  server_.set_payload_max_length(kLargestRequest);
  server_.set_keep_alive_max_count(1);  // who is idle holds no thread
  server_.set_keep_alive_timeout(kPatience);
  server_.set_read_timeout(kPatience);
  server_.set_write_timeout(kPatience);
  server_.set_tcp_nodelay(true);
  server_.set_default_headers({{"Cache-Control", "no-store"},
                               {"Referrer-Policy", "no-referrer"},
                               {"X-Content-Type-Options", "nosniff"},
                               // In a frame of another page a click could be led astray.
                               {"X-Frame-Options", "DENY"},
                               {"Content-Security-Policy", "frame-ancestors 'none'"}});
  listen(settings);
  answer();
  thread_ = std::thread([this] { server_.listen_after_bind(); });
  while (!server_.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

PageServer::~PageServer() {
  *ends_ = true;
  run_.close();
  server_.stop();
  thread_.join();
}

void PageServer::listen(const LivePageSettings& settings) {
  // Its own default lets two servers share a port.
  server_.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  int port = settings.port;
  if (port == 0) {
    port = server_.bind_to_any_port(settings.address);
  } else if (!server_.bind_to_port(settings.address, port)) {
    port = -1;
  }
  if (port <= 0) {
    throw std::runtime_error("cannot serve at " + settings.address + ":" +
                             std::to_string(settings.port) +
                             ": another program may be there already (port 0: any that is free), "
                             "or the address is none of this machine's");
  }
  const bool is_local = settings.address == "127.0.0.1";
  const std::string token = is_local ? "" : randomToken();
  guard_.emplace(settings.address, port, token);
  url_ = "http://" + settings.address + ":" + std::to_string(port) + "/";
  if (!token.empty()) url_ += "?token=" + token;
}

void PageServer::answer() {
  const auto seen = [](const httplib::Request& request) {
    return PageGuard::Request{request.get_header_value("Host"), request.get_header_value("Origin"),
                              request.get_param_value("token")};
  };
  // Before its body is read.
  server_.set_pre_routing_handler([this, seen](const auto& request, auto& response) {
    const bool looks = request.method == "GET" || request.method == "HEAD";
    const std::string why =
        looks ? guard_->whyNotLook(seen(request)) : guard_->whyNotCommand(seen(request));
    if (why.empty()) return httplib::Server::HandlerResponse::Unhandled;
    refuse(response, 403, why);
    return httplib::Server::HandlerResponse::Handled;
  });
  server_.Get("/", [this](const auto&, auto& response) {
    response.set_content(page_, "text/html; charset=utf-8");
  });
  server_.Get("/events", [this](const auto&, auto& response) { stream(response); });
  server_.Post("/command",
               [this](const auto& request, auto& response) { command(request, response); });
}

void PageServer::stream(httplib::Response& response) {
  if (++viewers_ > kMostViewers) {
    --viewers_;
    return refuse(response, 503, "as many look at this run as may");
  }
  auto viewed = std::make_shared<LiveRun::Viewed>();
  response.set_chunked_content_provider(
      "text/event-stream",
      [this, viewed](std::size_t, httplib::DataSink& sink) {
        const std::string event = run_.next(*viewed);
        if (event.empty()) {
          sink.done();
          return true;
        }
        return sink.write(event.data(), event.size());
      },
      [this](bool) { --viewers_; });
}

void PageServer::command(const httplib::Request& request, httplib::Response& response) {
  std::optional<RunCommand> command = commandOf(request.body);
  if (!command)
    return refuse(response, 400,
                  "no command: {\"do\": \"start\"}, pause, stop, home, "
                  "or go with x and y in m");
  const bool needs_robot =
      command->kind == RunCommand::Kind::kHome || command->kind == RunCommand::Kind::kGo;
  if (needs_robot && !has_robot_) return refuse(response, 409, "no robot listens");
  command->place_map -= origin_;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (commands_.size() >= kMostCommands) return refuse(response, 503, "too many commands");
  commands_.push_back(*command);
  response.status = 204;
}

std::optional<RunCommand> PageServer::nextCommand() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (commands_.empty()) return {};
  const RunCommand command = commands_.front();
  commands_.pop_front();
  return command;
}

}  // namespace cca
