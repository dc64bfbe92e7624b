#include "remote/worker.h"

#include <cstdio>

#include <unistd.h>

namespace rex::remote {

void runWorker(std::span<const Method> methods) {
  // Line by line, so that the last lines before a crash arrive.
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  int exitCode = 0;
  try {
    Session(Channel(kWorkerIn, kWorkerOut), methods).serve();
  } catch (const ProtocolError&) {
    exitCode = kProtocolFailure;
  } catch (const Closed&) {
    exitCode = kProtocolFailure;
  }
  std::fflush(stdout);
  ::_exit(exitCode);
}

}  // namespace rex::remote
