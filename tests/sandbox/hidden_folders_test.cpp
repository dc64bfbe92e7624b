#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sandbox/bubblewrap.h"
#include "support/temporary_folder.h"

namespace rex::sandbox {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

TEST(HiddenFolders, AreNoneWhereRexLiesOutsideOfUsr) {
  const TemporaryFolder place;
  EXPECT_THAT(hiddenFolders(place.path() / "rex-sandbox"), IsEmpty());
}

TEST(HiddenFolders, AreThatOfTheLauncherBelowUsr) {
  EXPECT_THAT(hiddenFolders("/usr/bin/rex-sandbox"), UnorderedElementsAre(fs::canonical("/usr/bin")));
}

class AllBut : public ::testing::Test {
 protected:
  AllBut() : root_(fs::canonical(place_.path())) {
    for (const char* folder : {"bin", "lib/rex/lib", "lib/other", "share/rex", "share/doc"})
      fs::create_directories(root_ / folder);
    std::ofstream(root_ / "lib" / "file") << "text";
  }
  TemporaryFolder place_;
  fs::path root_;
};

TEST_F(AllBut, IsTheFolderItselfIfNothingInItIsHidden) {
  EXPECT_THAT(allBut(root_, {"/somewhere/else"}), UnorderedElementsAre(root_));
}

TEST_F(AllBut, DividesFoldersAboveHiddenOnes) {
  EXPECT_THAT(allBut(root_, {root_ / "lib" / "rex", root_ / "share" / "rex"}),
              UnorderedElementsAre(root_ / "bin", root_ / "lib" / "other", root_ / "lib" / "file",
                                   root_ / "share" / "doc"));
}

TEST_F(AllBut, LeavesOutLinksThatLeadToHiddenOnes) {
  fs::create_directory_symlink("lib/rex", root_ / "link");
  fs::create_directory_symlink("lib", root_ / "lib64");
  const std::vector<fs::path> seen = allBut(root_, {root_ / "lib" / "rex"});
  EXPECT_THAT(seen, ::testing::Not(::testing::Contains(root_ / "link")));
  EXPECT_THAT(seen, ::testing::Not(::testing::Contains(root_ / "lib64")));
  EXPECT_THAT(seen, ::testing::Contains(root_ / "share"));
}

TEST_F(AllBut, IsNothingForAHiddenOrMissingFolder) {
  EXPECT_THAT(allBut(root_ / "lib" / "rex", {root_ / "lib"}), IsEmpty());
  EXPECT_THAT(allBut(root_ / "missing", {}), IsEmpty());
}

}  // namespace
}  // namespace rex::sandbox
