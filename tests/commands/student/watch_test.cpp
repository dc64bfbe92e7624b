// `rex watch` without a terminal: saves, its page, and its end.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interruption.h"
#include "commands/built_project.h"
#include "support/wait_until.h"
#include "support/web_connection.h"

namespace rex::cli::watch_test {

using ::testing::HasSubstr;
using ::testing::Not;

// `rex watch` in a process of its own, without a terminal, writing to a file.
class Watching : public BuiltProject {
 protected:
  fs::path main() const { return exercise() / "main.cpp"; }
  pid_t start(const std::vector<const char*>& more = {}) const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    const int log = ::open((root() / "log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, STDIN_FILENO), ::dup2(log, STDOUT_FILENO), ::dup2(log, STDERR_FILENO);
    std::vector<const char*> arguments = {"rex", "watch", "98"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    try {
      const HeldSignals held;
      const int code = runRex(static_cast<int>(arguments.size()), arguments.data(), {root(), build()});
      std::fflush(nullptr);
      ::_exit(code);
    } catch (const Interrupted&) {
      ::_exit(99);
    }
  }
  std::string log() const { return fs::exists(root() / "log") ? fileText(root() / "log") : ""; }
  bool hasGraded(int times) const {
    int count = 0;
    const std::string text = log();
    for (std::size_t at = text.find("graded in "); at != std::string::npos;
         at = text.find("graded in ", at + 1))
      ++count;
    return count >= times;
  }
  static int toExitCode(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

TEST_F(Watching, GradesAgainAtEverySaveUntilAllIsRight) {
  for (const bool polls : {false, true}) {
    rex({"reset", "98"});
    fs::remove(root() / "log");
    const pid_t child = start(polls ? std::vector<const char*>{"--poll"} : std::vector<const char*>{});
    ASSERT_TRUE(waitUntil([&] { return hasGraded(1); })) << log();
    EXPECT_THAT(log(), HasSubstr(polls ? "by polling; press Ctrl-C" : "by inotify; press Ctrl-C"));
    write(main(), "int main() { broken }\n");
    ASSERT_TRUE(waitUntil([&] { return hasGraded(2); })) << log();
    EXPECT_THAT(log(), HasSubstr("Not graded"));
    write(root() / "saved", kGood);
    fs::rename(root() / "saved", main());
    EXPECT_EQ(toExitCode(child), 0);
    EXPECT_THAT(log(), HasSubstr("3 of 3 points"));
    EXPECT_EQ(log().find('\033'), std::string::npos) << "no colours and no keys in a file";
  }
}

TEST_F(Watching, RenewsItsPageAtEverySave) {
  rex({"reset", "98"});
  const pid_t child = start({"--open"});
  ASSERT_TRUE(waitUntil([&] { return hasGraded(1); })) << log();
  const std::string text = log(), start = text.substr(text.find("page: ") + 6);
  const std::string url = start.substr(0, start.find('\n'));
  EXPECT_THAT(fetched(url, "", "</html>"), HasSubstr("<h1 id=\"98-template"));
  const std::string before = fetched(url, "frames", "graded in");
  EXPECT_THAT(before, HasSubstr("vscode://file"));
  EXPECT_THAT(before, Not(HasSubstr("Now passes: ")));
  // A hint that is opened in the page counts.
  const std::string host = url.substr(7, url.find('/', 7) - 7), ask = R"({"hint":"rotate"})";
  Connection connection(std::stoi(host.substr(host.find(':') + 1)));
  connection.send("POST " + url.substr(7 + host.size()) + "events HTTP/1.1\r\nHost: " + host +
                  "\r\nOrigin: http://" + host + "\r\nContent-Length: " + std::to_string(ask.size()) +
                  "\r\n\r\n" + ask);
  EXPECT_THAT(connection.readUntil("\r\n\r\n"), HasSubstr("204"));
  ASSERT_TRUE(waitUntil(
      [&] { return fetched(url, "frames", "\"source\"").find("Open hint 2") != std::string::npos; }));
  EXPECT_THAT(fileText(root() / ".rex" / "progress.json"), HasSubstr("\"rotate\": 1"));
  write(root() / "saved", kGood);
  fs::rename(root() / "saved", main());
  Connection viewer(std::stoi(host.substr(host.find(':') + 1)));
  viewer.send("GET " + url.substr(7 + host.size()) + "frames HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  EXPECT_THAT(viewer.readUntil("Now passes: A quarter turn", 60000), HasSubstr("Now passes: A quarter turn"));
  EXPECT_EQ(toExitCode(child), 0);
}

TEST_F(Watching, EndsWhenItIsAskedTo) {
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove(root() / "log");
    const pid_t child = start();
    ASSERT_TRUE(waitUntil([&] { return hasGraded(1); })) << log();
    ::kill(child, signal);
    EXPECT_EQ(toExitCode(child), 99);
  }
}

TEST_F(Watching, EndsAtOnceWithoutSuchACheck) {
  const Ended ended = rex({"watch", "98", "--check", "quarter-trn"});
  EXPECT_EQ(ended.code, 64);
  EXPECT_THAT(flat(ended.error), HasSubstr("'quarter-trn' (did you mean 'quarter-turn'?)"));
}

}  // namespace rex::cli::watch_test
