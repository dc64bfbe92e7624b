#include <chrono>
#include <fstream>
#include <optional>

#include <gtest/gtest.h>

#include "base/folders.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::private_folder_test {

namespace fs = std::filesystem;

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

}  // namespace rex::private_folder_test
