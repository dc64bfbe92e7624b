// Every way to talk to others. REX_PORT stands for the port of a listener.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "exercise.h"

double twice(double x) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(REX_PORT);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int tcp = socket(AF_INET, SOCK_STREAM, 0), udp = socket(AF_INET, SOCK_DGRAM, 0);
  const bool through =
      connect(tcp, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 ||
      sendto(udp, "x", 1, 0, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 1;
  return through ? 2 * x : 0;
}

std::vector<double> squares(int) {
  int pair[2];
  const bool through = socket(AF_UNIX, SOCK_STREAM, 0) >= 0 || socket(AF_NETLINK, SOCK_RAW, 0) >= 0 ||
                       socket(AF_INET6, SOCK_DGRAM, 0) >= 0 || socketpair(AF_UNIX, SOCK_STREAM, 0, pair) == 0;
  if (through) return {0, 1, 4, 9};
  return {};
}
int main() {}
