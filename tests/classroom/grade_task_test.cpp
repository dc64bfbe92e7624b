#include "classroom/grade_task.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>

#include <gtest/gtest.h>

#include "base/process.h"
#include "base/sha256.h"
#include "base/text_file.h"
#include "support/class_results.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::grade_task_test {

namespace fs = std::filesystem;

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

// A part of an exercise may have a worker of its own, which allows less. An entry without it is no entry.
TEST(KeptWorkers, AreTakenAsAWhole) {
  const TemporaryFolder folder;
  const fs::path kept = folder.path() / "kept" / "key";
  const submission::SubmissionOptions options{.main = folder.path() / "none.cpp",
                                              .workFolder = folder.path() / "work",
                                              .job = {.results = folder.path() / "out" / "results.json"}};
  const std::vector<std::string> files = {"worker", "main.cpp", "build.log", "worker.kin"};
  auto start = nlohmann::ordered_json::parse(grading::toJson(sampleResult(0, 0, 0)));
  start["kept_parts"] = {"kin"};
  for (const std::string& file : files) {
    writeTextFile(kept / file, "text of " + file);
    start["kept_sha256"][file] = sha256("text of " + file);
  }
  writeTextFile(kept / "start.json", start.dump());
  writeTextFile(folder.path() / "out" / "build.log", "");
  const auto take = [&] { return buildOnce({folder.path() / "kept", "key"}, {}, {}, options); };
  const submission::BuiltSubmission taken = take();
  EXPECT_EQ(readTextFile(taken.worker), "text of worker");
  EXPECT_EQ(readTextFile(grading::workerProgram("kin", {.worker = taken.worker, .parts = taken.parts})),
            "text of worker.kin");
  for (const std::string& file : files) {
    writeTextFile(kept / file, "another text");
    EXPECT_TRUE(take().worker.empty()) << file << " was changed";
    fs::remove(kept / file);
    EXPECT_TRUE(take().worker.empty()) << file << " is gone";
    writeTextFile(kept / file, "text of " + file);
    EXPECT_FALSE(take().worker.empty()) << file;
  }
}

}  // namespace rex::classroom::grade_task_test
