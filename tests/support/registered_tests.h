#pragma once

#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/process.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex {

/// What `ctest -N` prints of the tests of this build, one line each; `selection` are options of ctest. It is
/// called in a folder of its own, for it starts the folder's log anew, which belongs to the run that this
/// test is part of.
inline std::string registeredTests(const std::vector<std::string>& selection = {}) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "CTestTestfile.cmake") << "subdirs(\"" << ownFolder().string() << "\")\n";
  std::vector<std::string> command{"ctest", "--test-dir", folder.path().string(), "-N"};
  command.insert(command.end(), selection.begin(), selection.end());
  const ProcessResult result = runProcess(command);
  EXPECT_TRUE(result.ok()) << result.error;
  return result.output;
}

}  // namespace rex
