#include "live/open_browser.h"

#include <csignal>
#include <cstdlib>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include "base/escape.h"
#include "base/text_file.h"

namespace rex {
namespace {

std::string valueOf(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr ? value : "";
}

bool isSet(const char* variable) { return !valueOf(variable).empty(); }

bool hasScreen() { return isSet("DISPLAY") || isSet("WAYLAND_DISPLAY"); }

bool open(const std::string& url, const PrivateFolder& folder) {
  const std::filesystem::path page = folder.path() / "open.html";
  writeTextFile(page,
                "<!DOCTYPE html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0; url=" +
                    htmlText(url) + "\">\n");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, fd, "/dev/null", O_RDWR, 0);
  std::string program = "xdg-open", argument = page.string();
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
  const bool isOpen = posix_spawnp(&child, program.c_str(), &actions, &attributes, argv, environ) == 0;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return isOpen;
}

// `connection` names client, its port, server, its port.
std::string forwarding(const std::string& connection, int port) {
  std::vector<std::string> words(1);
  for (const char c : connection) c == ' ' ? words.emplace_back() : words.back() += c;
  const std::string user = valueOf("USER"), host = words.size() > 2 ? words[2] : "SERVER";
  return fmt::format("on your own machine, run: ssh -N -L {0}:127.0.0.1:{0} {1}{2}", port,
                     user.empty() ? "" : user + "@", host);
}

}  // namespace

std::string bringToUser(const LiveServer& server, const PrivateFolder* folder) {
  const std::string connection = valueOf("SSH_CONNECTION");
  if (!connection.empty()) return printable(forwarding(connection, server.port()));
  if (folder == nullptr || !hasScreen() || open(server.url(), *folder)) return {};
  return "no browser could be opened: there is no xdg-open";
}

}  // namespace rex
