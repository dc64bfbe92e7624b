#include "classroom/grade_task.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>

#include <gtest/gtest.h>

#include "base/process.h"
#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::grade_task_test {

class GraderFingerprint : public ::testing::Test {
 protected:
  GraderFingerprint() {
    if (runsInACopy()) return;
    for (const char* name :
         {"grader", "launcher", "worker.o", "library.so", "src/base/a.h", "src/base/b.h", "01-x/check.cpp"})
      writeTextFile(file(name), name);
  }
  bool runsInACopy() const { return folder_ != temporary_.path(); }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  std::string fingerprint(const std::string& flag = "-O1") const {
    submission::Toolchain toolchain;
    toolchain.compiler = "c++";
    toolchain.flags = {flag, "-isystem", file("src").string(), "-isystem", file("none").string()};
    toolchain.workerObject = file("worker.o");
    toolchain.grader = file("grader");
    toolchain.libraries = {file("library.so")};
    submission::ExerciseInfo exercise;
    exercise.folder = exercise.definition = file("01-x");
    return graderFingerprint(toolchain, exercise, file("launcher"));
  }
  // What a copy of this program computes of the same files.
  std::string fingerprintBy(const std::filesystem::path& program) const {
    const ProcessResult run = runProcess({"env", kFolder + ("=" + folder_.string()), program.string(),
                                          "--gtest_filter=*.TellsWhichProgramGrades"});
    const std::size_t at = run.output.find(kTold);
    return at == run.output.npos ? run.output + run.error : run.output.substr(at + std::strlen(kTold), 64);
  }

  static constexpr const char* kTold = "fingerprint: ";

 private:
  inline static const std::string kFolder = "REX_FINGERPRINT_FOLDER";
  TemporaryFolder temporary_;
  std::filesystem::path folder_ =
      std::getenv(kFolder.c_str()) != nullptr ? std::getenv(kFolder.c_str()) : temporary_.path().string();
};

TEST_F(GraderFingerprint, ChangesWithAllThatGrades) {
  const std::string before = fingerprint();
  EXPECT_EQ(before.size(), 64u);
  EXPECT_EQ(fingerprint(), before);
  EXPECT_NE(fingerprint("-O2"), before);
  for (const char* name :
       {"grader", "launcher", "worker.o", "library.so", "src/base/a.h", "01-x/check.cpp"}) {
    writeTextFile(file(name), "another");
    EXPECT_NE(fingerprint(), before) << name;
    writeTextFile(file(name), name);
    EXPECT_EQ(fingerprint(), before) << name;
  }
}

TEST_F(GraderFingerprint, TellsWhichHeaderHoldsWhat) {
  const std::string before = fingerprint();
  writeTextFile(file("src/base/a.h"), "src/base/b.h");
  writeTextFile(file("src/base/b.h"), "src/base/a.h");
  EXPECT_NE(fingerprint(), before);
}

TEST_F(GraderFingerprint, PassesByWhatIsNotCompiledIn) {
  const std::string before = fingerprint();
  writeTextFile(file("src/base/a.cpp"), "in the library already");
  EXPECT_EQ(fingerprint(), before);
}

// The program that runs compiles students' files and refuses them. It may have any name. Its copies run this
// test to tell what they see.
TEST_F(GraderFingerprint, TellsWhichProgramGrades) {
  if (runsInACopy()) {
    std::cout << kTold << fingerprint() << std::endl;
    return;
  }
  const std::filesystem::path same = file("same"), changed = file("changed");
  for (const auto& copy : {same, changed}) std::filesystem::copy_file("/proc/self/exe", copy);
  std::ofstream(changed, std::ios::app) << "one more rule";
  EXPECT_EQ(fingerprintBy(same), fingerprint());
  EXPECT_EQ(fingerprintBy(changed).size(), 64u);
  EXPECT_NE(fingerprintBy(changed), fingerprint());
}

TEST_F(GraderFingerprint, DoesWithoutALauncher) {
  const std::string before = fingerprint();
  std::filesystem::remove(file("launcher"));
  EXPECT_NE(fingerprint(), before);
}

TEST_F(GraderFingerprint, NeedsAllFiles) {
  std::filesystem::remove(file("worker.o"));
  EXPECT_REX_ERROR(fingerprint(), "worker.o: cannot read this file");
}

}  // namespace rex::classroom::grade_task_test
