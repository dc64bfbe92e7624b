#include "live/live_server.h"

#include <chrono>
#include <memory>
#include <thread>

#include <gmock/gmock.h>
#include <sys/resource.h>

#include "base/error.h"
#include "support/web_connection.h"

namespace rex::live_server_test {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";

class LiveServerTest : public testing::Test {
 protected:
  LiveServerTest() : server({.token = kToken}) { server.offer("", {"text/html", "the page"}); }

  std::string host() const { return "127.0.0.1:" + std::to_string(server.port()); }
  std::string line(const std::string& method, const std::string& path) const {
    return method + " /" + kToken + "/" + path + " HTTP/1.1\r\nHost: " + host() + "\r\n";
  }
  std::string answer(const std::string& request) const {
    Connection connection(server.port());
    connection.send(request);
    return connection.readUntil("\r\n\r\n");
  }
  std::string posted(const std::string& body, const std::string& headers) const {
    return line("POST", "events") + headers + "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
           body;
  }
  std::string own() const { return "Origin: http://" + host() + "\r\n"; }

  LiveServer server;
};

TEST_F(LiveServerTest, ServesThePageUnderItsAddressOnly) {
  EXPECT_EQ(server.url(), "http://" + host() + "/" + kToken + "/");
  const std::string page = answer(line("GET", "") + "\r\n");
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy: default-src 'none'; script-src 'self'"));
  EXPECT_THAT(answer(line("GET", "nothing") + "\r\n"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(answer("GET / HTTP/1.1\r\nHost: " + host() + "\r\n\r\n"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(answer("GET /0123456789abcdef0123456789abcdee/ HTTP/1.1\r\nHost: " + host() + "\r\n\r\n"),
              StartsWith("HTTP/1.1 404"));
}

TEST_F(LiveServerTest, ServesNoFileOfTheMachine) {
  for (const char* path :
       {"../etc/passwd", "../../../../../../etc/passwd", "/etc/passwd", "%2e%2e/%2e%2e/etc/passwd",
        "..%2f..%2fetc%2fpasswd", "file:///etc/passwd", "%00", "page.html\\..\\..\\etc"}) {
    const std::string reply = answer(line("GET", path) + "\r\n");
    EXPECT_THAT(reply, StartsWith("HTTP/1.1 404")) << path;
    EXPECT_EQ(reply.find("root:"), std::string::npos);
  }
}

TEST_F(LiveServerTest, RefusesOtherHostsAndOrigins) {
  const std::string get = std::string("GET /") + kToken + "/ HTTP/1.1\r\n";
  for (const char* name :
       {"evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "[::2]", "10.0.0.1", "",
        "127.0.0.1:evil.example", "127.0.0.1:80.evil.example", "[::1].evil.example", "[::1]:80:evil.example",
        "[::1]evil", "localhost:", "localhost:80 evil", "[::1"})
    EXPECT_THAT(answer(get + "Host: " + name + "\r\n\r\n"), StartsWith("HTTP/1.1 403")) << name;
  EXPECT_THAT(answer(get + "\r\n"), StartsWith("HTTP/1.1 403"));
  for (const char* name : {"localhost:8080", "[::1]", "[::1]:8080"})  // as through ssh -L
    EXPECT_THAT(answer(get + "Host: " + name + "\r\n\r\n"), StartsWith("HTTP/1.1 200")) << name;
  EXPECT_THAT(answer(line("GET", "") + "Origin: http://evil.example\r\n\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer(line("GET", "") + "Sec-Fetch-Site: cross-site\r\n\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer(posted("[]", "Origin: http://evil.example\r\n")), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer(posted("[]", "Origin: null\r\n")), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer(posted("[]", "")), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(server.takeMessages(0us), testing::IsEmpty());
}

TEST_F(LiveServerTest, TakesMessagesInOrder) {
  EXPECT_THAT(answer(posted("[1]", own())), StartsWith("HTTP/1.1 204"));
  EXPECT_THAT(answer(posted("[2]", own())), StartsWith("HTTP/1.1 204"));
  EXPECT_THAT(server.takeMessages(1s), testing::ElementsAre("[1]", "[2]"));
}

TEST_F(LiveServerTest, BoundsMessages) {
  EXPECT_THAT(answer(posted(std::string(LiveServer::kLongestMessage + 1, ' '), own())),
              StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(answer(line("POST", "events") + own() + "Transfer-Encoding: chunked\r\n\r\n5\r\n[    \r\n"),
              StartsWith("HTTP/1.1 411"));
  EXPECT_THAT(answer(line("POST", "events") + own() + "\r\n"), StartsWith("HTTP/1.1 411"));
  EXPECT_THAT(answer(line("PUT", "events") + own() + "Content-Length: 0\r\n\r\n"),
              StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(answer(line("POST", "other") + own() + "Content-Length: 0\r\n\r\n"),
              StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(answer("GET /" + std::string(100000, 'a') + " HTTP/1.1\r\nHost: " + host() + "\r\n\r\n"),
              testing::AnyOf(StartsWith("HTTP/1.1 4"), testing::IsEmpty()));
  for (std::size_t k = 0; k < LiveServer::kMostMessages; ++k) answer(posted("[]", own()));
  EXPECT_THAT(answer(posted("[]", own())), StartsWith("HTTP/1.1 429"));
  EXPECT_EQ(server.takeMessages(0us).size(), LiveServer::kMostMessages);
}

TEST_F(LiveServerTest, StreamsFramesAlsoToLateViewers) {
  server.publish("{\"first\":1}");
  Connection early(server.port());
  early.send(line("GET", "frames") + "\r\n");
  EXPECT_THAT(early.readUntil("first"), HasSubstr("text/event-stream"));
  server.publish("{\"second\":2}");
  EXPECT_THAT(early.readUntil("second"), HasSubstr("data: {\"second\":2}\n\n"));
  Connection late(server.port());
  late.send(line("GET", "frames") + "\r\n");
  EXPECT_THAT(late.readUntil("second"), testing::Not(HasSubstr("first")));
  EXPECT_EQ(server.viewers(), 2);
}

TEST(LiveServer, TellsViewersTheLastFrameAndThatItEnds) {
  auto server = std::make_unique<LiveServer>(LiveServerOptions{.token = kToken});
  Connection viewer(server->port());
  viewer.send(std::string("GET /") + kToken + "/frames HTTP/1.1\r\nHost: localhost\r\n\r\n");
  viewer.readUntil("event-stream");
  server->publish("last");
  server.reset();
  EXPECT_THAT(viewer.readUntil("data: end"),
              testing::ContainsRegex("data: last\n\n[^d]*event: end\ndata: end"));
}

TEST_F(LiveServerTest, ASlowViewerMissesFramesAndSlowsNobody) {
  Connection slow(server.port()), fast(server.port());
  slow.send(line("GET", "frames") + "\r\n");
  fast.send(line("GET", "frames") + "\r\n");
  const std::string much(500000, 'x');
  for (int k = 0; k < 60; ++k) server.publish(much + std::to_string(k));
  server.publish("last");
  EXPECT_THAT(fast.readUntil("last"), HasSubstr("last"));
}

TEST_F(LiveServerTest, BoundsViewers) {
  std::vector<std::unique_ptr<Connection>> all;
  server.publish("now");
  for (int k = 0; k < LiveServer::kMostViewers; ++k) {
    all.push_back(std::make_unique<Connection>(server.port()));
    all.back()->send(line("GET", "frames") + "\r\n");
    EXPECT_THAT(all.back()->readUntil("now"), HasSubstr("now"));
  }
  EXPECT_THAT(answer(line("GET", "frames") + "\r\n"), StartsWith("HTTP/1.1 503"));
}

TEST_F(LiveServerTest, SurvivesAThousandConnections) {
  rlimit most{};
  getrlimit(RLIMIT_NOFILE, &most);
  rlimit more = most;
  more.rlim_cur = std::min<rlim_t>(most.rlim_max, 4096);
  setrlimit(RLIMIT_NOFILE, &more);
  Connection viewer(server.port());
  viewer.send(line("GET", "frames") + "\r\n");
  server.publish("before");
  EXPECT_THAT(viewer.readUntil("before"), HasSubstr("before"));
  {
    std::vector<std::unique_ptr<Connection>> crowd;
    for (int k = 0; k < 1000; ++k)
      crowd.push_back(std::make_unique<Connection>(server.port(), SOCK_NONBLOCK, "127.0.0.2"));
    for (const auto& one : crowd) one->send("GET /");
    server.publish("amid");
    EXPECT_THAT(viewer.readUntil("amid"), HasSubstr("amid"));
  }
  EXPECT_THAT(answer(line("GET", "") + "\r\n"), StartsWith("HTTP/1.1 200"));
  setrlimit(RLIMIT_NOFILE, &most);
}

// httplib alone keeps such lines: 210 MB in a few seconds.
TEST_F(LiveServerTest, RefusesHeadersWithoutAnEnd) {
  const std::string start = line("GET", ""), filler = "X: " + std::string(997, 'x') + "\r\n";
  for (const std::string& begin : {std::string("GET /"), start, start + "X: "}) {
    Connection endless(server.port());
    endless.send(begin);
    for (int k = 0; k < 17; ++k) endless.send(filler);
    EXPECT_THAT(endless.readUntil("\r\n\r\n"), StartsWith("HTTP/1.1 431"));
    for (int k = 0; k < 100 && !endless.hasEnded(); ++k) std::this_thread::sleep_for(10ms);
    EXPECT_TRUE(endless.hasEnded());
  }
  Connection second(server.port());  // a header of a later request of the same connection
  second.send(start + "\r\n");
  EXPECT_THAT(second.readUntil("the page"), StartsWith("HTTP/1.1 200"));
  second.send(start);
  for (int k = 0; k < 17; ++k) second.send(filler);
  EXPECT_THAT(second.readUntil("\r\n\r\n"), StartsWith("HTTP/1.1 431"));
}

TEST_F(LiveServerTest, TakesLongHeadersInPieces) {
  Connection connection(server.port());
  for (int request = 0; request < 2; ++request) {
    connection.send(line("GET", ""));
    for (int k = 0; k < 7; ++k) {
      connection.send("X: " + std::string(2000, 'x') + "\r\n");
      std::this_thread::sleep_for(20ms);
    }
    connection.send("\r\n");
    EXPECT_THAT(connection.readUntil("the page"), StartsWith("HTTP/1.1 200"));
  }
}

TEST_F(LiveServerTest, BoundsConnectionsOfAnAddress) {
  std::vector<std::unique_ptr<Connection>> crowd;
  for (int k = 0; k < 64; ++k) {
    crowd.push_back(std::make_unique<Connection>(server.port(), 0, "127.0.0.2"));
    crowd.back()->send(line("GET", "") + "\r\n");
    EXPECT_THAT(crowd.back()->readUntil("the page"), StartsWith("HTTP/1.1 200"));
  }
  Connection refused(server.port(), 0, "127.0.0.2");
  EXPECT_EQ(refused.readUntil("\r\n\r\n", 1000), "");
  EXPECT_TRUE(refused.hasEnded());
  EXPECT_FALSE(crowd.back()->hasEnded());
  EXPECT_THAT(answer(line("GET", "") + "\r\n"), StartsWith("HTTP/1.1 200")) << "from another address";
}

TEST(LiveServer, EndsConnectionsThatTakeTheirTime) {
  LiveServer server({.token = kToken, .requestTime = 300ms});
  server.publish("now");
  const std::string start = std::string("GET /") + kToken + "/frames HTTP/1.1\r\nHost: localhost\r\n";
  Connection viewer(server.port()), slow(server.port()), slowBody(server.port());
  viewer.send(start + "\r\n");
  EXPECT_THAT(viewer.readUntil("now"), HasSubstr("now"));
  slow.send(start + "X: ");
  slowBody.send(std::string("POST /") + kToken +
                "/events HTTP/1.1\r\nHost: localhost\r\nOrigin: http://localhost\r\n" +
                "Content-Length: 60000\r\n\r\n");
  for (int k = 0; k < 200 && !(slow.hasEnded() && slowBody.hasEnded()); ++k) {
    slow.send("x"), slowBody.send("x");
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_TRUE(slow.hasEnded());
  EXPECT_TRUE(slowBody.hasEnded());
  server.publish("later");
  EXPECT_THAT(viewer.readUntil("later"), HasSubstr("later")) << "streams take any time";
}

TEST_F(LiveServerTest, GivesFilesPoliciesOfTheirOwn) {
  server.offer("replay.html", {.type = "text/html", .bytes = "film", .policy = "sandbox"});
  const std::string replay = answer(line("GET", "replay.html?v=1") + "\r\n");
  EXPECT_THAT(replay, HasSubstr("Content-Security-Policy: sandbox\r\n"));
  EXPECT_THAT(replay, testing::Not(HasSubstr("default-src")));
}

TEST(LiveServer, TokensAreRandom) {
  EXPECT_EQ(randomToken().size(), 32u);
  EXPECT_NE(randomToken(), randomToken());
}

std::string refusalOf(const LiveServerOptions& options) {
  try {
    const LiveServer server(options);
  } catch (const Error& error) {
    return error.what();
  }
  return "served";
}

TEST(LiveServer, RefusesWhatItCannotServe) {
  EXPECT_THAT(refusalOf({.token = "short"}),
              HasSubstr("found 5 characters, wanted at least 16 hexadecimal digits"));
  EXPECT_THAT(refusalOf({.address = "192.0.2.1", .port = 4711}),
              HasSubstr("serving 192.0.2.1:4711: found the system refuses it"));
  const LiveServer server({.token = kToken});
  EXPECT_THAT(refusalOf({.port = server.port()}), HasSubstr("found another program there, wanted"));
}

TEST(LiveServer, IsServedOnOtherAddressesUnderNumbers) {
  const LiveServer server({.address = "0.0.0.0", .token = kToken});
  for (const auto& [name, status] :
       {std::pair{"192.0.2.7", "200"}, {"evil.example", "403"}, {"localhost", "200"}}) {
    Connection connection(server.port());
    connection.send(std::string("GET /") + kToken + "/none HTTP/1.1\r\nHost: " + name + "\r\n\r\n");
    EXPECT_THAT(connection.readUntil("\r\n\r\n"), HasSubstr(status == std::string("200") ? "404" : status));
  }
}

}  // namespace rex::live_server_test
