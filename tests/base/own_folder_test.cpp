#include <gtest/gtest.h>

#include "base/folders.h"

namespace rex {
namespace {

namespace fs = std::filesystem;

TEST(OwnFolder, IsTheBuildFolderWhoseLibrariesTheProgramUses) {
  EXPECT_EQ(ownFolder(), fs::canonical(REX_BINARY_DIR));
  EXPECT_FALSE(isInstalled());
}

TEST(OwnFolder, LeadsToTheSourceTree) { EXPECT_EQ(homeFolder(), fs::canonical(REX_SOURCE_DIR)); }

TEST(OwnFolder, HoldsTheFilesBelowIt) {
  EXPECT_TRUE(isOwnFile(ownFolder()));
  EXPECT_TRUE(isOwnFile(homeFolder() / "data" / "man.ors"));
  EXPECT_FALSE(isOwnFile(homeFolder().parent_path()));
  EXPECT_FALSE(isOwnFile(homeFolder().string() + "-other/file"));
}

}  // namespace
}  // namespace rex
