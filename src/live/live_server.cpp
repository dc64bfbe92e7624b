#include "live/live_server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <httplib.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include "base/error.h"

namespace rex {

/// The connections of a server by the threads that serve them, to bound what strangers take before a handler
/// sees their request: those that take too long, as who sends a byte now and then would hold one of few;
/// headers without an end; many connections from one address. httplib bounds only the time between two bytes.
class Connections {
 public:
  static constexpr int kMostOfAnAddress = 64;
  static constexpr std::size_t kLongestHeader = 16384;

  /// `requestTime`: from the beginning of a connection, or the last answer, to the end of a request. An
  /// answer may take twelve times as long; streams take any time.
  explicit Connections(std::chrono::milliseconds requestTime) : requestTime_(requestTime) {}

  /// Finds the connection to `port` that was accepted last. Returns a descriptor of its own for it, or -1. No
  /// program that we start inherits either. Shuts it down if its address has as many as it may have.
  int accepted(int port);

  /// The calling thread serves that descriptor from now on, and closes it at the end.
  void begin(int descriptor);
  /// Waits until the header of the next request is there, which the parser then takes. Shuts the connection
  /// down if it is too long, or nothing more comes for two seconds.
  void awaitHeader();
  void beginAnswer(bool isStream);
  void end();

  /// Shuts down those whose time is over; their threads then end by themselves.
  void endSlow();

 private:
  using Clock = std::chrono::steady_clock;
  struct Served {
    int descriptor = -1;
    Clock::time_point until{};
  };
  struct Known {
    int descriptor = -1;
    std::string address{};
  };
  int allow(Clock::time_point until);

  std::chrono::milliseconds requestTime_;
  std::mutex mutex_{};
  std::map<std::thread::id, Served> served_{};
  std::map<ino_t, Known> known_{};  // inodes of sockets
};

namespace {

int portOf(const sockaddr_storage& address) {
  if (address.ss_family == AF_INET) return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
  if (address.ss_family == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port);
  return -1;
}

// The address of who has made this connection to our port; empty if it is no such connection.
std::string addressOf(int port, int descriptor) {
  sockaddr_storage own{}, other{};
  socklen_t size = sizeof own, otherSize = sizeof other;
  std::array<char, NI_MAXHOST> name{};
  auto* const peer = reinterpret_cast<sockaddr*>(&other);
  if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&own), &size) != 0 || portOf(own) != port ||
      ::getpeername(descriptor, peer, &otherSize) != 0 ||
      ::getnameinfo(peer, otherSize, name.data(), name.size(), nullptr, 0, NI_NUMERICHOST) != 0)
    return {};
  return name.data();
}

// Waits until a whole header has arrived. Looks at it without taking it: httplib would take any number of
// lines. Leaves the connection empty for an answer if the header is too long.
enum class Header { kWhole, kTooLong, kNone };
Header headerOn(int connection) {
  constexpr int kSilence = 2000;  // milliseconds
  std::string seen(Connections::kLongestHeader, '\0');
  const auto wakeAt = [&](int bytes) {
    ::setsockopt(connection, SOL_SOCKET, SO_RCVLOWAT, &bytes, sizeof bytes);
  };
  for (ssize_t known = 0;;) {
    pollfd polled{connection, POLLIN, 0};
    if (::poll(&polled, 1, kSilence) != 1) return Header::kNone;
    const ssize_t n = ::recv(connection, seen.data(), seen.size(), MSG_PEEK | MSG_DONTWAIT);
    if (n <= known) return Header::kNone;  // it has ended
    known = n;
    const bool isWhole = std::string_view(seen).substr(0, static_cast<std::size_t>(n)).find("\r\n\r\n") !=
                         std::string_view::npos;
    const bool isFull = static_cast<std::size_t>(n) == seen.size();
    wakeAt(isWhole || isFull ? 1 : static_cast<int>(n) + 1);
    if (isWhole) return Header::kWhole;
    if (!isFull) continue;
    static_cast<void>(::recv(connection, seen.data(), seen.size(), MSG_DONTWAIT));
    return Header::kTooLong;
  }
}

}  // namespace

// The new one is among our descriptors, and nobody says which.
int Connections::accepted(int port) {
  const std::lock_guard lock(mutex_);
  constexpr int kHighest = 4096;  // we serve far fewer, and the lowest number that is free is taken
  for (int descriptor = 0; descriptor < kHighest; ++descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISSOCK(status.st_mode) || known_.contains(status.st_ino))
      continue;
    const std::string address = addressOf(port, descriptor);
    if (address.empty()) continue;
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
    const int copy = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    const auto ofAddress = std::count_if(known_.begin(), known_.end(),
                                         [&](const auto& one) { return one.second.address == address; });
    if (copy < 0 || ofAddress >= kMostOfAnAddress) ::shutdown(descriptor, SHUT_RDWR);
    if (copy >= 0) known_[status.st_ino] = {copy, address};
    return copy;
  }
  return -1;
}

void Connections::begin(int descriptor) {
  const std::lock_guard lock(mutex_);
  served_[std::this_thread::get_id()] = {descriptor, Clock::now() + requestTime_};
}

// Returns the descriptor that the calling thread serves, or -1.
int Connections::allow(Clock::time_point until) {
  const std::lock_guard lock(mutex_);
  const auto found = served_.find(std::this_thread::get_id());
  if (found == served_.end()) return -1;
  found->second.until = until;
  return found->second.descriptor;
}

void Connections::awaitHeader() {
  constexpr std::string_view kRefusal =
      "HTTP/1.1 431 Request Header Fields Too Large\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
  const int connection = allow(Clock::now() + requestTime_);
  if (connection < 0) return;
  const Header header = headerOn(connection);
  if (header == Header::kWhole) return;
  if (header == Header::kTooLong)
    static_cast<void>(::send(connection, kRefusal.data(), kRefusal.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  ::shutdown(connection, SHUT_RDWR);
}

void Connections::beginAnswer(bool isStream) {
  allow(isStream ? Clock::time_point::max() : Clock::now() + 12 * requestTime_);
}

void Connections::end() {
  const std::lock_guard lock(mutex_);
  const auto found = served_.find(std::this_thread::get_id());
  if (found == served_.end()) return;
  const int descriptor = found->second.descriptor;
  served_.erase(found);
  if (descriptor < 0) return;
  std::erase_if(known_, [&](const auto& one) { return one.second.descriptor == descriptor; });
  ::close(descriptor);
}

void Connections::endSlow() {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  for (const auto& [thread, one] : served_)
    if (now > one.until && one.descriptor >= 0) ::shutdown(one.descriptor, SHUT_RDWR);
}

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

// The name in "name", "name:port" or "[::1]:port"; empty if anything else comes after it.
std::string hostName(const std::string& host) {
  const std::size_t end = host.starts_with('[') ? host.find(']') + 1 : std::min(host.find(':'), host.size());
  const bool isNoPort = end < host.size() && (host[end] != ':' || end + 1 == host.size() ||
                                              host.find_first_not_of("0123456789", end + 1) != host.npos);
  return isNoPort ? "" : host.substr(0, end);
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
