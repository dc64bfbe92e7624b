#include "base/process.h"

#include "base/child_process.h"

namespace rex {

ProcessResult runProcess(const std::vector<std::string>& argv, const ProcessOptions& options) {
  const ChildProcess::Deadline deadline = ChildProcess::after(options.timeout);
  ChildProcess child(argv, options);
  // A program need not read all of its input.
  static_cast<void>(child.write(options.input, deadline));
  return child.finish(deadline);
}

}  // namespace rex
