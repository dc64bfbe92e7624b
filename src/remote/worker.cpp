#include "remote/worker.h"

#include <cstdio>

#include <malloc.h>
#include <unistd.h>

#include "base/error.h"

namespace rex::remote {

void runWorker(std::span<const Method> methods) {
  // By default, large vectors get fresh pages again and again, which cost more than what is computed in them.
  ::mallopt(M_MMAP_THRESHOLD, 64 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
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

extern "C" void rexOfAnotherPart(Session&, Reader&, Writer&) {
  throw Error({.what = "a check calls a function that exercise.toml does not name for its part"});
}

extern "C" void rexNotAllowedHere() {
  throw Error({.what = "calls a function of the library that this part of the exercise does not allow"});
}

}  // namespace rex::remote
