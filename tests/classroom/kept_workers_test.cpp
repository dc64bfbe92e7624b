#include "classroom/kept_workers.h"

#include <gtest/gtest.h>

#include "base/sha256.h"
#include "base/text_file.h"
#include "grading/grading_job.h"
#include "support/class_results.h"
#include "support/temporary_folder.h"

namespace rex::classroom::kept_workers_test {

namespace fs = std::filesystem;

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

}  // namespace rex::classroom::kept_workers_test
