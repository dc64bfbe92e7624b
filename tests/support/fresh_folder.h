#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "support/paths.h"

namespace rex {

/// An empty folder of the build tree. What a test leaves in it stays until the next run, to be looked at.
inline std::filesystem::path freshFolder(const std::string& name) {
  const std::filesystem::path folder = ownFolder() / "tests-out" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// The same for helpers that several tests call, which may run at the same time: one folder for each.
inline std::filesystem::path freshFolderOfTest(const std::string& name) {
  return freshFolder(name + "-" + testing::UnitTest::GetInstance()->current_test_info()->name());
}

}  // namespace rex
