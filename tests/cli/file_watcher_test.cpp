#include "cli/file_watcher.h"

#include <chrono>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace rex::cli::file_watcher_test {

namespace fs = std::filesystem;
using Method = FileWatcher::Method;

class FileWatcherTest : public ::testing::TestWithParam<Method> {
 protected:
  fs::path file() const { return temporary_.path() / "main.cpp"; }
  void write(const fs::path& where, const std::string& text) const { std::ofstream(where) << text; }
  // Waits while another thread does something a little later.
  static FileWatcher::Event waitWhile(FileWatcher& watcher, const std::function<void()>& act) {
    std::thread actor([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      act();
    });
    const FileWatcher::Event event = watcher.wait();
    actor.join();
    return event;
  }
  TemporaryFolder temporary_;
};

TEST_P(FileWatcherTest, NoticesASaveInPlaceAndOneByRenaming) {
  write(file(), "one");
  FileWatcher watcher(file(), GetParam());
  EXPECT_EQ(watcher.method(), GetParam());
  EXPECT_EQ(watcher.describe(), GetParam() == Method::kInotify ? "inotify" : "polling");
  EXPECT_EQ(waitWhile(watcher, [&] { write(file(), "two, longer"); }), FileWatcher::Event::kSaved);
  // As editors save: a new file takes the name. Others in the folder do not matter.
  EXPECT_EQ(waitWhile(watcher,
                      [&] {
                        write(temporary_.path() / "other.txt", "x");
                        write(temporary_.path() / "main.cpp~", "three");
                        fs::rename(temporary_.path() / "main.cpp~", file());
                      }),
            FileWatcher::Event::kSaved);
}

TEST_P(FileWatcherTest, WaitsForAFileThatIsMissing) {
  FileWatcher watcher(file(), GetParam());
  EXPECT_EQ(waitWhile(watcher, [&] { write(file(), "one"); }), FileWatcher::Event::kSaved);
}

TEST_P(FileWatcherTest, NoticesASaveThatCameBeforeTheWait) {
  write(file(), "one");
  FileWatcher watcher(file(), GetParam());
  write(file(), "while it was graded");
  EXPECT_EQ(watcher.wait(), FileWatcher::Event::kSaved);
}

INSTANTIATE_TEST_SUITE_P(All, FileWatcherTest, ::testing::Values(Method::kInotify, Method::kPolling));

TEST(FileWatcher, PollsAndSaysWhyWhereInotifyFails) {
  const FileWatcher watcher("/no/such/folder/main.cpp");
  EXPECT_EQ(watcher.method(), Method::kPolling);
  EXPECT_EQ(watcher.describe(), "polling (inotify: No such file or directory)");
}

}  // namespace rex::cli::file_watcher_test
