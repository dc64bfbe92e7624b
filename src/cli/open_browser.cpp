#include "cli/open_browser.h"

#include <csignal>
#include <cstdlib>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include "base/escape.h"
#include "base/text_file.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

std::string valueOf(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr ? value : "";
}

bool isSet(const char* variable) { return !valueOf(variable).empty(); }

}  // namespace

bool hasScreen() { return (isSet("DISPLAY") || isSet("WAYLAND_DISPLAY")) && !isSet("SSH_CONNECTION"); }

void openInBrowser(const std::string& file) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, fd, "/dev/null", O_RDWR, 0);
  std::string program = "xdg-open", argument = file;
  char* const argv[] = {program.data(), argument.data(), nullptr};
  // Ctrl-C is not for the browser, and signals that we hold back are not held back there.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  ::sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  if (posix_spawnp(&child, program.c_str(), &actions, &attributes, argv, environ) != 0)
    note("no browser could be opened: there is no xdg-open");
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
}

void openAddress(const std::string& url, const PrivateFolder& folder) {
  const std::filesystem::path page = folder.path() / "open.html";
  writeTextFile(page,
                "<!DOCTYPE html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0; url=" +
                    htmlText(url) + "\">\n");
  openInBrowser(page.string());
}

void sayForwarding(int port) {
  const std::string connection = valueOf("SSH_CONNECTION");  // client, its port, server, its port
  if (connection.empty()) return;
  std::vector<std::string> words(1);
  for (const char c : connection) c == ' ' ? words.emplace_back() : words.back() += c;
  const std::string user = valueOf("USER"), server = words.size() > 2 ? words[2] : "SERVER";
  say(fmt::format("on your own machine, run: ssh -N -L {0}:127.0.0.1:{0} {1}{2}", port,
                  user.empty() ? "" : harmless(user) + "@", harmless(server)));
}

}  // namespace rex::cli
