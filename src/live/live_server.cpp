#include "live/live_server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <deque>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/error.h"
#include "live/connections_internal.h"

namespace rex {
namespace {

constexpr std::chrono::milliseconds kLook{200};  // between two looks for slow connections

// One thread per connection, up to a bound. Beyond that new connections wait until others end; idle and slow
// ones end soon.
class BoundedQueue : public httplib::TaskQueue {
  // Nothing, or, in the library's newer versions, whether it was taken.
  using Enqueued = decltype(std::declval<httplib::TaskQueue&>().enqueue({}));

 public:
  BoundedQueue(Connections& connections, const int& port) : connections_(connections), port_(port) {}

  Enqueued enqueue(std::function<void()> serve) override {
    const int connection = connections_.accepted(port_);
    connections_.endSlow();
    std::unique_lock lock(mutex_);
    while (running_ >= LiveServer::kMostConnections) {
      ended_.wait_for(lock, kLook);
      connections_.endSlow();
    }
    ++running_;
    std::thread([this, connection, serve = std::move(serve)] {
      connections_.begin(connection);
      connections_.awaitHeader();
      serve();
      connections_.end();
      const std::lock_guard held(mutex_);
      --running_;
      ended_.notify_all();
    }).detach();
    return Enqueued(true);
  }

  void on_idle() override { connections_.endSlow(); }

  void shutdown() override {
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [&] { return running_ == 0; });
  }

 private:
  Connections& connections_;
  const int& port_;
  std::mutex mutex_;
  std::condition_variable ended_;
  int running_ = 0;
};

bool isHex(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); }

// The name in "name:port" or "[::1]:port".
std::string hostName(const std::string& host) {
  if (host.starts_with('[')) return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.find(':'));
}

bool isNumericAddress(const std::string& name) {
  std::array<unsigned char, sizeof(in6_addr)> ignored{};
  if (name.starts_with('[') && name.ends_with(']'))
    return inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), ignored.data()) == 1;
  return inet_pton(AF_INET, name.c_str(), ignored.data()) == 1;
}

std::string ownName() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : std::string();
}

// Takes the same time for every wrong text of the right length.
bool isSame(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  int difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= a[i] ^ b[i];
  return difference == 0;
}

constexpr const char* kPolicyHeader = "Content-Security-Policy";
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' blob: data:; frame-src 'self'; media-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

}  // namespace

std::string randomToken() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Error({.what = "a token for the live page", .found = "no random numbers from the system"});
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

struct LiveServer::Parts {
  explicit Parts(const LiveServerOptions& given) : options(given), connections(given.requestTime) {}

  LiveServerOptions options;
  int port = 0;
  Connections connections;
  httplib::Server http{};
  std::thread listener{};
  std::atomic<bool> hasEnded = false;

  std::mutex mutex{};
  std::condition_variable changed{};  // a new frame, a new message, or the end
  std::map<std::string, std::shared_ptr<const LiveFile>> files{};
  std::string frame{};
  std::uint64_t frameNumber = 0;
  std::deque<std::string> messages{};
  int viewers = 0;
  bool isEnding = false;

  // Names resolve to anything, also to us: by names alone, only those are trusted that nobody else can own.
  bool isOurHost(const std::string& host) const {
    const std::string name = hostName(host);
    if (name == "127.0.0.1" || name == "localhost" || name == "[::1]") return true;
    if (options.address == "127.0.0.1") return false;
    return isNumericAddress(name) || (!name.empty() && name == ownName());
  }

  // The status with which to refuse a request, or 0.
  int refusal(const httplib::Request& request) const {
    if (request.get_header_value_count("Host") != 1 || !isOurHost(request.get_header_value("Host")))
      return 403;
    const bool isPost = request.method == "POST";
    if (request.method != "GET" && !isPost) return 405;
    const std::string own = "http://" + request.get_header_value("Host");
    if (request.has_header("Origin") ? request.get_header_value("Origin") != own : isPost) return 403;
    // Links may lead to the page itself, for those who know the token; other pages load nothing from here.
    const std::string site = request.get_header_value("Sec-Fetch-Site");
    const bool isLink = !isPost && request.get_header_value("Sec-Fetch-Mode") == "navigate" &&
                        request.get_header_value("Sec-Fetch-Dest") == "document";
    if (!site.empty() && site != "same-origin" && site != "none" && !isLink) return 403;
    if (request.path.size() < options.token.size() + 2 || request.path[0] != '/' ||
        request.path[options.token.size() + 1] != '/' ||
        !isSame(std::string_view(request.path).substr(1, options.token.size()), options.token))
      return 404;
    // Without a length, the body could be of any size.
    if (isPost && (!request.has_header("Content-Length") || request.has_header("Transfer-Encoding") ||
                   request.has_header("Content-Encoding")))
      return 411;
    return 0;
  }

  std::string nameIn(const httplib::Request& request) const {
    return request.path.substr(options.token.size() + 2);
  }

  void get(const httplib::Request& request, httplib::Response& response) {
    const std::string name = nameIn(request);
    connections.beginAnswer(name == "frames");
    if (name == "frames") return stream(response);
    const std::lock_guard lock(mutex);
    const auto found = files.find(name);
    if (found == files.end()) {
      response.status = 404;
      return;
    }
    const std::shared_ptr<const LiveFile> file = found->second;
    // In parts: whole texts would be compressed first, which takes two seconds per megabyte.
    const auto part = [file](std::size_t from, std::size_t size, httplib::DataSink& sink) {
      return sink.write(file->bytes.data() + from, size);
    };
    if (file->bytes.empty()) response.set_content("", file->type);
    if (!file->bytes.empty()) response.set_content_provider(file->bytes.size(), file->type, part);
    if (file->policy.empty()) return;
    response.headers.erase(kPolicyHeader);
    response.set_header(kPolicyHeader, file->policy);
  }

  void post(const httplib::Request& request, httplib::Response& response) {
    connections.beginAnswer(false);
    const std::lock_guard lock(mutex);
    response.status = nameIn(request) != "events" ? 404 : messages.size() >= kMostMessages ? 429 : 204;
    if (response.status != 204) return;
    messages.push_back(request.body);
    changed.notify_all();
  }

  void stream(httplib::Response& response) {
    {
      const std::lock_guard lock(mutex);
      if (viewers >= kMostViewers) {
        response.status = 503;
        return;
      }
      ++viewers;
    }
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, last = std::uint64_t{0}, isOver = false](std::size_t, httplib::DataSink& sink) mutable {
          if (isOver) return false;
          std::string text;
          {
            std::unique_lock lock(mutex);
            changed.wait_for(lock, std::chrono::seconds(2), [&] { return isEnding || frameNumber != last; });
            isOver = isEnding;
            text = frameNumber != last ? "data: " + frame + "\n\n" : ": nothing new\n\n";
            if (isOver) text += "event: end\ndata: end\n\n";  // or the page would ask again and again
            last = frameNumber;
          }
          return sink.write(text.data(), text.size());
        },
        [this](bool) {
          const std::lock_guard lock(mutex);
          --viewers;
          changed.notify_all();
        });
  }

  void prepare() {
    http.new_task_queue = [this] { return new BoundedQueue(connections, port); };
    http.set_idle_interval(kLook);
    // The last word on a request, before the next one on the same connection.
    http.set_logger([this](const httplib::Request&, const httplib::Response& answer) {
      if (answer.get_header_value("Connection") != "close") connections.awaitHeader();
    });
    // The library's own choice would let another program serve on this port, too.
    http.set_socket_options([](int socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http.set_tcp_nodelay(true);
    http.set_keep_alive_max_count(1000000);
    http.set_keep_alive_timeout(2);
    http.set_read_timeout(2);
    http.set_write_timeout(5);
    http.set_payload_max_length(kLongestMessage);
    http.set_default_headers({{kPolicyHeader, kPolicy},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cache-Control", "no-store"}});
    http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      response.status = refusal(request);
      if (response.status == 0) {
        response.status = -1;  // as yet unknown
        return httplib::Server::HandlerResponse::Unhandled;
      }
      return httplib::Server::HandlerResponse::Handled;
    });
    http.Get(".*", [this](const httplib::Request& q, httplib::Response& a) { get(q, a); });
    http.Post(".*", [this](const httplib::Request& q, httplib::Response& a) { post(q, a); });
  }
};

LiveServer::LiveServer(const LiveServerOptions& options) : parts_(std::make_unique<Parts>(options)) {
  Parts& parts = *parts_;
  std::string& token = parts.options.token;
  if (token.empty()) token = randomToken();
  if (token.size() < 16 || !std::all_of(token.begin(), token.end(), isHex))
    throw Error({.what = "the token of a live page",
                 .found = fmt::format("{} characters", token.size()),
                 .wanted = "at least 16 hexadecimal digits"});
  parts.prepare();
  errno = 0;
  const bool isBound = options.port == 0
                           ? (parts.port = parts.http.bind_to_any_port(options.address)) > 0
                           : parts.http.bind_to_port(options.address, parts.port = options.port);
  const int cause = errno;
  if (!isBound)
    throw Error({.what = fmt::format("serving {}:{}", options.address, options.port),
                 .found = cause == EADDRINUSE ? "another program there" : "the system refuses it",
                 .wanted = "an address of this machine, and a port that is free"});
  parts.listener = std::thread([&parts] {
    parts.http.listen_after_bind();
    parts.hasEnded = true;
  });
}

LiveServer::~LiveServer() {
  {
    std::unique_lock lock(parts_->mutex);
    parts_->isEnding = true;
    parts_->changed.notify_all();
    // stop() cuts streams off: those that read learn before that it ends.
    parts_->changed.wait_for(lock, std::chrono::seconds(1), [&] { return parts_->viewers == 0; });
  }
  while (!parts_->http.is_running() && !parts_->hasEnded)
    std::this_thread::yield();  // stop() needs one of them
  parts_->http.stop();
  parts_->listener.join();
}

int LiveServer::port() const { return parts_->port; }

std::string LiveServer::url() const {
  const std::string& address = parts_->options.address;
  const std::string host = address == "0.0.0.0" ? ownName() : address;
  return fmt::format("http://{}:{}/{}/", host, parts_->port, parts_->options.token);
}

void LiveServer::offer(const std::string& name, LiveFile file) {
  const std::lock_guard lock(parts_->mutex);
  parts_->files[name] = std::make_shared<const LiveFile>(std::move(file));
}

void LiveServer::withdraw(const std::string& name) {
  const std::lock_guard lock(parts_->mutex);
  parts_->files.erase(name);
}

void LiveServer::publish(const std::string& frame) {
  const std::lock_guard lock(parts_->mutex);
  parts_->frame = frame;
  ++parts_->frameNumber;
  parts_->changed.notify_all();
}

std::vector<std::string> LiveServer::takeMessages(std::chrono::microseconds atMost) {
  std::unique_lock lock(parts_->mutex);
  parts_->changed.wait_for(lock, atMost, [&] { return !parts_->messages.empty(); });
  std::vector<std::string> taken(std::make_move_iterator(parts_->messages.begin()),
                                 std::make_move_iterator(parts_->messages.end()));
  parts_->messages.clear();
  return taken;
}

int LiveServer::viewers() const {
  const std::lock_guard lock(parts_->mutex);
  return parts_->viewers;
}

}  // namespace rex
