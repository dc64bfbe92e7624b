#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/folders.h"
#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::opened_folder_test {

namespace fs = std::filesystem;

class OpenedFolderTest : public ::testing::Test {
 protected:
  OpenedFolderTest() {
    writeTextFile(path() / "b/file", "text");
    fs::create_symlink("b", path() / "a");
    fs::create_symlink("b/file", path() / "c");
  }
  fs::path path() const { return temporary_.path(); }
  TemporaryFolder temporary_;
};

TEST_F(OpenedFolderTest, ListsWhatIsInItAndWhatItIs) {
  const OpenedFolder folder(path());
  for (int twice = 0; twice < 2; ++twice) {
    const auto entries = folder.entries();
    ASSERT_EQ(entries.size(), 3u);
    EXPECT_EQ(entries[0].name, "a");
    EXPECT_EQ(entries[0].type, fs::file_type::symlink);
    EXPECT_EQ(entries[1].type, fs::file_type::directory);
    EXPECT_EQ(entries[2].type, fs::file_type::symlink);
  }
  EXPECT_EQ(folder.typeOf("none"), fs::file_type::not_found);
  EXPECT_EQ(folder.folder("b").typeOf("file"), fs::file_type::regular);
}

TEST_F(OpenedFolderTest, FollowsNoLinkAndSaysWhy) {
  const OpenedFolder folder(path());
  EXPECT_REX_ERROR(folder.folder("a"), "a: cannot read this folder: found no folder");
  EXPECT_REX_ERROR(folder.file("c"), "c: cannot be read: found a symbolic link");
  EXPECT_REX_ERROR(folder.file("none"), "none: cannot be read: found no file");
  EXPECT_REX_ERROR(OpenedFolder(path() / "none"), "none: cannot read this folder: found No such file");
}

TEST_F(OpenedFolderTest, StaysInTheFolderThatItOpened) {
  const OpenedFolder inner = OpenedFolder(path()).folder("b");
  fs::rename(path() / "b", path() / "gone");
  writeTextFile(path() / "b/file", "another");
  const OpenedFile file = inner.file("file");
  std::array<char, 16> text{};
  EXPECT_EQ(::read(file.fd(), text.data(), text.size()), 4);
  EXPECT_STREQ(text.data(), "text");
  EXPECT_EQ(file.size(), 4u);
  EXPECT_GT(file.modifiedAt(), 0);
}

}  // namespace rex::opened_folder_test
