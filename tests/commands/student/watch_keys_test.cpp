// `rex watch` as somebody meets it who sits at a terminal: a program on a pseudo terminal, keys pressed one
// by one.
#include <array>
#include <csignal>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "commands/built_project.h"

namespace rex::cli::watch_keys_test {

using ::testing::HasSubstr;
using ::testing::Not;

class WatchKeys : public BuiltProject {
 protected:
  static constexpr const char* kPrompt = "[q]uit\r\n";

  void TearDown() override {
    if (terminal_ >= 0) ::close(terminal_);
    if (child_ > 0) ::kill(child_, SIGKILL), ::waitpid(child_, nullptr, 0);
  }

  void start(const std::vector<std::string>& words, const char* noColour = "") {
    termios ordinary{};
    ::cfmakeraw(&ordinary);
    ordinary.c_iflag |= ICRNL;
    ordinary.c_oflag |= OPOST | ONLCR;
    ordinary.c_lflag |= ICANON | ECHO | ISIG;
    ordinary.c_cc[VINTR] = 3;
    child_ = ::forkpty(&terminal_, nullptr, &ordinary, nullptr);
    ASSERT_GE(child_, 0);
    if (child_ > 0) return;
    ::setenv("NO_COLOR", noColour, 1);
    ::setenv("TERM", "xterm", 1);
    const std::string folder = root().string();
    std::vector<const char*> argv = {kRexOfTree.c_str(), folder.c_str()};
    for (const std::string& word : words) argv.push_back(word.c_str());
    argv.push_back(nullptr);
    ::execv(kRexOfTree.c_str(), const_cast<char* const*>(argv.data()));
    ::_exit(127);
  }

  void press(const std::string& keys) const {
    ASSERT_EQ(::write(terminal_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }

  // What comes until `text` has come, or the program ended, or nothing came for very long.
  std::string until(const std::string& text) {
    constexpr int kLongest = 120'000;  // milliseconds
    std::string seen;
    std::array<char, 4096> buffer;
    pollfd polled{terminal_, POLLIN, 0};
    while (seen.find(text) == seen.npos && ::poll(&polled, 1, kLongest) == 1) {
      const ssize_t size = ::read(terminal_, buffer.data(), buffer.size());
      if (size <= 0) break;
      seen.append(buffer.data(), static_cast<std::size_t>(size));
    }
    all_ += seen;
    return seen;
  }
  std::string answerTo(const std::string& keys, const std::string& end = kPrompt) {
    press(keys);
    return until(end);
  }

  int waitForEnd() {
    int status = 0;
    ::waitpid(std::exchange(child_, -1), &status, 0);
    return status;
  }

  // Lines are edited and keys echoed, as a shell wants it.
  bool isOrdinary() const {
    termios now{};
    return ::tcgetattr(terminal_, &now) == 0 && (now.c_lflag & (ICANON | ECHO)) == (ICANON | ECHO);
  }

  std::string all_;

 private:
  pid_t child_ = -1;
  int terminal_ = -1;

 protected:
  void closeTerminal() { ::close(std::exchange(terminal_, -1)); }
};

TEST_F(WatchKeys, GiveHintsPlacesAndProgress) {
  start({"watch", "98"});
  EXPECT_THAT(until(kPrompt), HasSubstr("0 of 3 points"));
  EXPECT_FALSE(isOrdinary());
  EXPECT_THAT(answerTo("h"), HasSubstr("1 of 2: Where does the point"));
  EXPECT_THAT(answerTo("h"), HasSubstr("2 of 2: And (0, 1)?"));
  EXPECT_THAT(answerTo("p"), HasSubstr("out/98-template/results.json"));
  EXPECT_THAT(answerTo("l"), HasSubstr("0 of 1 exercises solved"));
  EXPECT_THAT(answerTo("n"), Not(HasSubstr("watching"))) << "there is no next one before a full score";
  EXPECT_THAT(answerTo("t"), HasSubstr("graded in"));
  press("q");
  const int status = waitForEnd();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status;
  EXPECT_TRUE(isOrdinary());
}

TEST_F(WatchKeys, GradeOneCheckAgainAndAgain) {
  start({"watch", "98"});
  EXPECT_THAT(until(kPrompt), HasSubstr("[s]ingle check"));
  EXPECT_THAT(answerTo("s", "go back: "), HasSubstr(" 1  A quarter turn [quarter-turn]"));
  EXPECT_THAT(answerTo("99\r"), HasSubstr("no check is called '99'"));
  answerTo("s", "go back: ");
  EXPECT_THAT(answerTo("hlx\bquarter\r"), HasSubstr("no check is called 'hlquarter'"))
      << "letters are no keys here";
  answerTo("s", "go back: ");
  EXPECT_THAT(answerTo("keeps-length\r"), HasSubstr("[keeps-length]"));
  answerTo("a");
  answerTo("s", "go back: ");
  EXPECT_THAT(answerTo("\r"), Not(HasSubstr("graded")));
  answerTo("s", "go back: ");
  const std::string single = answerTo("1\r");
  EXPECT_THAT(single, HasSubstr("[quarter-turn]"));
  EXPECT_THAT(single, HasSubstr("0 of 1 points"));
  EXPECT_THAT(single, HasSubstr("[a]ll checks"));
  write(exercise() / "main.cpp", kGood);
  const std::string saved = until(kPrompt);
  EXPECT_THAT(saved, HasSubstr("1 of 1 points"));
  EXPECT_THAT(saved, Not(HasSubstr("[n]ext"))) << "one check is not all";
  const std::string all = answerTo("a");
  EXPECT_THAT(all, HasSubstr("3 of 3 points"));
  EXPECT_THAT(all, HasSubstr("[n]ext"));
  press("q");
  EXPECT_EQ(waitForEnd(), 0);
}

TEST_F(WatchKeys, ResetOnlyAfterAYes) {
  const std::string starter = fileText(exercise() / "main.cpp");
  write(exercise() / "main.cpp", kGood);
  start({"watch", "98"});
  until(kPrompt);
  EXPECT_THAT(answerTo("x", "key: "), HasSubstr("Start again with"));
  answerTo("n");
  EXPECT_EQ(fileText(exercise() / "main.cpp"), kGood);
  answerTo("x", "key: ");
  EXPECT_THAT(answerTo("y"), HasSubstr("main.backup-1.cpp"));
  EXPECT_EQ(fileText(exercise() / "main.cpp"), starter);
  EXPECT_EQ(fileText(exercise() / "main.backup-1.cpp"), kGood);
  EXPECT_THAT(until(kPrompt), HasSubstr("0 of 3 points")) << "graded without a key";
  press("q");
  waitForEnd();
}

TEST_F(WatchKeys, GoToTheNextExerciseAfterAFullScore) {
  addExercise("99-again");
  write(exercise() / "main.cpp", kGood);
  start({"watch", "98"});
  EXPECT_THAT(until(kPrompt), HasSubstr("[n]ext"));
  EXPECT_THAT(answerTo("n"), HasSubstr("watching " + (folderOf("99-again") / "main.cpp").string()));
  press("q");
  waitForEnd();
}

TEST_F(WatchKeys, GoOnWithAFileThatWasGoneForAWhile) {
  start({"watch", "98"});
  until(kPrompt);
  fs::remove(exercise() / "main.cpp");
  EXPECT_THAT(answerTo("t"), HasSubstr("found no file"));
  write(exercise() / "main.cpp", kGood);
  EXPECT_THAT(until(kPrompt), HasSubstr("3 of 3 points"));
  press("q");
  EXPECT_EQ(waitForEnd(), 0);
}

TEST_F(WatchKeys, LeaveTheTerminalInOrderAfterControlC) {
  start({"watch", "98"});
  until(kPrompt);
  press("\x03");
  EXPECT_EQ(WTERMSIG(waitForEnd()), SIGINT);
  EXPECT_TRUE(isOrdinary());
  EXPECT_EQ(workFolders(), 0);

  const fs::path mark = root() / "started";
  write(exercise() / "main.cpp",
        "#include <fstream>\n#include <unistd.h>\n#include \"exercise.h\"\n"
        "Eigen::Vector2d rotated(const Eigen::Vector2d&, double) {\n  std::ofstream(\"" +
            mark.string() + "\") << 1;\n  for (;;) sleep(1000);\n}\nint main() {}\n");
  closeTerminal();
  start({"watch", "98"});
  until("check 1 of 3");  // the line of progress
  press("\x03");
  EXPECT_EQ(WTERMSIG(waitForEnd()), SIGINT);
  EXPECT_TRUE(isOrdinary());
  EXPECT_EQ(workFolders(), 0);
}

TEST_F(WatchKeys, EndWithTheTerminal) {
  start({"watch", "98"});
  until(kPrompt);
  closeTerminal();
  const int status = waitForEnd();
  // By the signal, or by the end of the input if that is seen first.
  EXPECT_TRUE(WIFSIGNALED(status) ? WTERMSIG(status) == SIGHUP : WEXITSTATUS(status) == 1) << status;
  EXPECT_EQ(workFolders(), 0);
}

TEST_F(WatchKeys, ShowColoursUnlessRefused) {
  useRealCompiler();  // what is quick has no line of progress
  for (const char* noColour : {"", "1"}) {
    all_.clear();
    start({"watch", "98"}, noColour);
    until(kPrompt);
    for (const char* key : {"h", "p", "l"}) answerTo(key);
    press("q");
    waitForEnd();
    EXPECT_EQ(all_.find('\033') == all_.npos, *noColour == '1') << all_;
    EXPECT_THAT(all_, HasSubstr("98-template: c")) << "a line of progress";
    closeTerminal();
  }
}

}  // namespace rex::cli::watch_keys_test
