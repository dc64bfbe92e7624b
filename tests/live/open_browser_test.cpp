#include "live/open_browser.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "base/text_file.h"
#include "support/temporary_folder.h"

namespace rex::open_browser_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A machine with a screen, on which only what lies in the folder can be run.
class OpenBrowser : public testing::Test {
 protected:
  OpenBrowser() : server({}), folder(temporary.path()) {
    for (const char* name : {"PATH", "DISPLAY", "WAYLAND_DISPLAY", "SSH_CONNECTION", "USER"}) {
      const char* value = std::getenv(name);
      before_.emplace_back(name, value != nullptr ? value : "");
      ::unsetenv(name);
    }
    ::setenv("PATH", temporary.path().c_str(), 1);
    ::setenv("DISPLAY", ":9", 1);
  }
  ~OpenBrowser() override {
    for (const auto& [name, value] : before_)
      value.empty() ? ::unsetenv(name.c_str()) : ::setenv(name.c_str(), value.c_str(), 1);
  }
  // A browser that writes down what it is called with.
  void installBrowser() const {
    const fs::path program = temporary.path() / "xdg-open";
    writeTextFile(program, "#!/bin/sh\necho \"$@\" >'" + called().string() + "'\n");
    fs::permissions(program, fs::perms::owner_all);
  }
  fs::path called() const { return temporary.path() / "called"; }
  std::string call() const {
    for (int k = 0; k < 500; ++k, std::this_thread::sleep_for(std::chrono::milliseconds(10)))
      if (fs::exists(called()) && !readTextFile(called()).empty()) return readTextFile(called());
    return {};
  }

  TemporaryFolder temporary;
  LiveServer server;
  PrivateFolder folder;

 private:
  std::vector<std::pair<std::string, std::string>> before_;
};

TEST_F(OpenBrowser, HidesTheAddressInAPage) {
  installBrowser();
  EXPECT_EQ(bringToUser(server, &folder), "");
  const fs::path page = folder.path() / "open.html";
  EXPECT_EQ(call(), page.string() + "\n");
  EXPECT_THAT(readTextFile(page), HasSubstr("url=" + server.url() + "\""));
}

TEST_F(OpenBrowser, SaysThatThereIsNone) {
  EXPECT_EQ(bringToUser(server, &folder), "no browser could be opened: there is no xdg-open");
}

TEST_F(OpenBrowser, OpensNothingWithoutAFolderAScreenOrOverSsh) {
  installBrowser();
  EXPECT_EQ(bringToUser(server, nullptr), "");
  ::setenv("SSH_CONNECTION", "192.0.2.1 50000 192.0.2.2\x1b[31m 22", 1);
  ::setenv("USER", "ada", 1);
  const std::string port = std::to_string(server.port());
  EXPECT_THAT(bringToUser(server, &folder),
              testing::AllOf(HasSubstr("run: ssh -N -L " + port + ":127.0.0.1:" + port + " ada@192.0.2.2"),
                             testing::Not(HasSubstr("\x1b"))));
  ::unsetenv("SSH_CONNECTION");
  ::unsetenv("DISPLAY");
  EXPECT_EQ(bringToUser(server, &folder), "");
  EXPECT_FALSE(fs::exists(folder.path() / "open.html"));
  EXPECT_FALSE(fs::exists(called()));
}

}  // namespace rex::open_browser_test
