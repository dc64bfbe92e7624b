#include "base/folders.h"

#include <array>
#include <chrono>
#include <fstream>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::folders_test {

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

void makeOld(const fs::path& folder) {
  fs::last_write_time(folder, fs::file_time_type::clock::now() - std::chrono::hours(2));
}

TEST(PrivateFolder, LivesAsLongAsItsOwner) {
  const TemporaryFolder temporary;
  std::optional<PrivateFolder> folder(temporary.path());
  EXPECT_EQ(folder->path().parent_path(), temporary.path());
  std::ofstream(folder->path() / "file") << "text";
  folder.reset();
  EXPECT_TRUE(fs::is_empty(temporary.path()));
  EXPECT_REX_ERROR(PrivateFolder("/no/such/folder"), "cannot make a temporary folder in /no/such/folder");
}

TEST(PrivateFolder, RemovesThoseWhoseOwnersWereKilled) {
  const TemporaryFolder temporary;
  const fs::path killed = temporary.path() / "rex-work-aaaaaa", young = temporary.path() / "rex-work-bbbbbb",
                 course = temporary.path() / "rex-course";
  for (const fs::path& folder : {killed, young, course}) {
    fs::create_directory(folder);
    std::ofstream(folder / "file") << "text";
  }
  const PrivateFolder held(temporary.path());
  for (const fs::path& folder : {killed, course, held.path()}) makeOld(folder);
  const PrivateFolder next(temporary.path());
  EXPECT_FALSE(fs::exists(killed));
  for (const fs::path& folder : {young, course, held.path(), next.path()}) EXPECT_TRUE(fs::exists(folder));
}

// A process that has ended, whose number is free.
pid_t endedProcess() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

TEST(Leftovers, AreThoseOfEndedProcesses) {
  const TemporaryFolder temporary;
  const std::string ended = std::to_string(endedProcess()), alive = std::to_string(::getpid());
  const auto write = [&](const std::string& name) { writeTextFile(temporary.path() / name, "x"); };
  write("zoe/01/main.cpp." + ended + ".new"), write("grades.csv." + ended + ".new");
  const std::vector<std::string> kept = {"grades.csv",      "zoe/main.cpp." + alive + ".new",
                                         "notes.new",       "a.b.new",
                                         "zoe/01/main.cpp", "." + ended + ".new",
                                         ended + ".new",    "x.-" + ended + ".new"};
  for (const std::string& name : kept) write(name);
  fs::create_directory_symlink(temporary.path() / "zoe", temporary.path() / ("link." + ended + ".new"));
  removeLeftovers(temporary.path(), 1);
  EXPECT_FALSE(fs::exists(temporary.path() / ("grades.csv." + ended + ".new")));
  EXPECT_TRUE(fs::exists(temporary.path() / ("zoe/01/main.cpp." + ended + ".new"))) << "deeper";
  removeLeftovers(temporary.path(), 2);
  EXPECT_FALSE(fs::exists(temporary.path() / ("zoe/01/main.cpp." + ended + ".new")));
  EXPECT_TRUE(fs::is_symlink(temporary.path() / ("link." + ended + ".new")));
  for (const std::string& name : kept) EXPECT_TRUE(fs::exists(temporary.path() / name)) << name;
  removeLeftovers(temporary.path() / "none");
}

}  // namespace rex::folders_test
