#include "classroom/stored_result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "classroom/gradebook.h"
#include "grading/hidden_seed.h"
#include "support/class_results.h"
#include "support/expect_error.h"
#include "support/file_openings.h"
#include "support/temporary_folder.h"

namespace rex::classroom::stored_result_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

class StoredResultTest : public ::testing::Test {
 protected:
  fs::path out() const { return folder_.path(); }
  fs::path file(const std::string& name = kResults) const { return resultFolder(out(), task_) / name; }
  StoredResult stored(const std::string& secret = {}) const { return readStored(task_, out(), secret); }
  // Changes the file as somebody would who knows how to make a seal.
  void edit(const std::string& name, const std::string& pointer, const Json& value) const {
    Json json = Json::parse(readTextFile(file(name)));
    json[Json::json_pointer(pointer)] = value;
    json["inputs"]["result_sha256"] = grading::computeSeal(json.dump(), "");
    writeTextFile(file(name), json.dump());
  }
  // A result with these points, which waits to be accepted.
  void holdBack(int points) const {
    saveSample(out() / "other", task_, sampleResult(points, 0, 0));
    fs::create_directories(file(kRegraded));
    fs::rename(resultFolder(out() / "other", task_) / kResults, file(kRegraded) / kResults);
    fs::remove_all(out() / "other");
  }

  TemporaryFolder folder_;
  Task task_ = sampleTask("bob");
};

TEST_F(StoredResultTest, TellsWhatBecameOfATask) {
  EXPECT_EQ(stored().state, TaskState::kMissing);
  saveSample(out(), task_, sampleResult(3, 4, 0));
  EXPECT_EQ(stored().state, TaskState::kDone);
  EXPECT_TRUE(stored().isDone());
  EXPECT_EQ(stored().result->score, 7);
  EXPECT_EQ(stored().before, 7);
  EXPECT_EQ(stored().now(), 7);
  task_.seed = 3;
  EXPECT_EQ(stored().state, TaskState::kStale);
  EXPECT_EQ(stored().before, 7) << "of the same text";
  EXPECT_EQ(stored().now(), std::nullopt);
  task_.sourceSha256 = "another text";
  EXPECT_EQ(stored().before, std::nullopt);
  task_ = sampleTask("bob");
  edit(kResults, "/outcome", "grader_error");
  EXPECT_EQ(stored().state, TaskState::kFailed);
  EXPECT_EQ(stored().before, std::nullopt);
  edit(kResults, "/outcome", "fail");
  edit(kResults, "/score", 8);
  EXPECT_EQ(stored().state, TaskState::kRefused);
  EXPECT_THAT(stored().why, HasSubstr("a result that does not add up"));
  edit(kResults, "/score", 7);
  edit(kResults, "/exercise/id", "02-control");
  EXPECT_THAT(stored().why, HasSubstr("a result of another exercise: found '02-control'"));
  EXPECT_FALSE(stored().isDone());
  edit(kResults, "/exercise/id", 5);
  EXPECT_EQ(stored().state, TaskState::kRefused);
  EXPECT_THAT(stored().why, HasSubstr("field 'exercise.id'"));
  writeTextFile(file(), "some other file");
  EXPECT_EQ(stored().state, TaskState::kStale);
}

// A hash can be made by whoever can write the file.
TEST_F(StoredResultTest, BelievesWithTheSecretOnlyWhatItSealed) {
  saveSample(out(), task_, sampleResult(3, 4, 0));
  const std::string secret = "the secret of a course";
  EXPECT_TRUE(stored().isDone());
  EXPECT_FALSE(stored(secret).isDone());
  EXPECT_EQ(stored(secret).state, TaskState::kDone) << "tables do not ask for it";
  EXPECT_THAT(stored(secret).why,
              HasSubstr("not written with the secret of the course: found no result_hmac"));
  const auto seal = [&](const std::string& student) {
    const std::string sum = Json::parse(readTextFile(file()))["inputs"]["result_sha256"];
    edit(kResults, "/inputs/result_hmac",
         grading::hmacSha256(secret, student + "\n" + task_.inputsSha256() + "\n" + sum + "\n"));
  };
  seal("bob");
  EXPECT_TRUE(stored(secret).isDone());
  seal("zoe");
  EXPECT_FALSE(stored(secret).isDone()) << "the result of another student";
  seal("bob");
  edit(kResults, "/message", "well done");
  EXPECT_TRUE(stored().isDone());
  EXPECT_FALSE(stored(secret).isDone());
}

TEST_F(StoredResultTest, KnowsWhatItWasMadeWith) {
  saveSample(out(), task_, sampleResult(3, 4, 0));
  EXPECT_FALSE(stored().with.has_value()) << "it does not say";
  edit(kResults, "/inputs/level", 2), edit(kResults, "/inputs/secret_id", "abc");
  EXPECT_EQ(stored().with->level, static_cast<sandbox::Level>(2));
  EXPECT_EQ(stored().with->secretId, "abc");
  EXPECT_EQ(stored().with->seed, std::nullopt);
  EXPECT_FALSE(stored().with->alone);
  edit(kResults, "/inputs/seed", 5), edit(kResults, "/inputs/alone", true);
  EXPECT_EQ(stored().with->seed, 5u);
  EXPECT_TRUE(stored().with->alone);
  edit(kResults, "/inputs/level", 9);
  EXPECT_FALSE(stored().with.has_value()) << "there is no such level";
}

TEST_F(StoredResultTest, KnowsWhetherPicturesWereKeptAndAreThere) {
  saveSample(out(), task_, sampleResult(3, 1, 0));
  EXPECT_FALSE(stored().evidence);
  edit(kResults, "/volatile/evidence", true);
  EXPECT_TRUE(stored().hasEvidence) << "of no check that failed";
  edit(kResults, "/volatile/checks/0/picture", "checks/hand.png");
  EXPECT_TRUE(stored().evidence);
  EXPECT_FALSE(stored().hasEvidence);
  writeTextFile(file("checks/hand.png"), "");
  EXPECT_TRUE(stored().hasEvidence);
}

TEST_F(StoredResultTest, KeepsTheOldPointsUntilFewerAreAccepted) {
  Task old = task_;
  old.seed = 3;
  saveSample(out(), old, sampleResult(3, 4, 0));
  holdBack(2);
  EXPECT_EQ(stored().state, TaskState::kDone);
  EXPECT_EQ(stored().result->score, 7);
  EXPECT_EQ(stored().waiting, 2);
  EXPECT_EQ(stored().now(), 2);
  ClassRun run = readClassRun({task_}, out());
  acceptRegradings(run);
  EXPECT_EQ(run.stored[0].result->score, 2);
  EXPECT_EQ(run.stored[0].waiting, std::nullopt);
  EXPECT_EQ(stored().result->score, 2);
  EXPECT_FALSE(fs::exists(file(kRegraded)));
  holdBack(1);
  writeTextFile(file(kRegraded) / kResults, "half");
  EXPECT_EQ(stored().waiting, std::nullopt) << "no result";
}

// Another program may write it while the tables are made: they do not contradict each other then.
TEST_F(StoredResultTest, IsReadOnceForAllThatIsMadeOfIt) {
  saveSample(out(), task_, sampleResult(3, 4, 0));
  FileOpenings openings(file().parent_path());
  const ClassRun run = readClassRun({task_}, out());
  EXPECT_EQ(openings.of(kResults), 1);
  saveSample(out(), task_, sampleResult(0, 0, 0));
  const int written = openings.of(kResults);
  const GradebookSource source{.points = {{task_.exercise, 10}}};
  const Gradebook book = makeGradebook(run, source);
  EXPECT_EQ(book.row("bob", task_.exercise)->final, 700);
  EXPECT_EQ(run.stored[0].result->score, 7);
  EXPECT_EQ(openings.of(kResults), written);
}

TEST_F(StoredResultTest, NeedsASecretOfSomeLength) {
  writeTextFile(out() / "secret", "short");
  EXPECT_REX_ERROR(readClassRun({}, out(), out() / "secret"), "the secret of the course is too short");
  EXPECT_EQ(classSecret({}), "");
}

}  // namespace rex::classroom::stored_result_test
