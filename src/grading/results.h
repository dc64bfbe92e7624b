#pragma once
// The result of a grading, and its file results.json.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grading/limits.h"
#include "grading/worker_failure.h"
#include "sandbox/confinement.h"

namespace rex::grading {

/// Visible checks show what they tried and what came out; hidden ones only which property failed.
enum class Group { kVisible, kHidden };

/// The fields of a result file, in its order: schema "grade-result/1". All text is valid UTF-8. What differs
/// between two runs of the same grading (times, memory, pictures), and records, which count for nothing, are
/// under "volatile", so the rest compares byte for byte.
struct SourceFile {
  std::string name{};
  std::string sha256{};
};

/// The requirement that was nearest to its limit, or furthest beyond it, over all cases of a check. Texts
/// include their units; they are empty for hidden checks, and if nothing was measured.
struct WorstValue {
  std::string property{};
  std::string value{};  ///< the distance from what was wanted, or the value that has a limit
  std::string limit{};
  int caseNumber = 0;  ///< from 1; 0: outside of cases
};

/// A figure of a visible check that passed, which may be better than points require. It counts for nothing.
struct Record {
  std::string name{};  ///< "length of the path of growStar"
  double value = 0;
  std::string unit{};  ///< may be empty
  bool isMoreBetter = false;
};

struct CheckResult {
  std::string id{};
  std::string part{};
  std::string title{};
  Group group = Group::kVisible;
  std::optional<Outcome> status{};  ///< nothing: not run
  int points = 0;
  int maxPoints = 0;
  std::string message{};   ///< one readable line, without the input; empty if passed
  std::string property{};  ///< the property that did not hold
  std::string expected{};  ///< with unit; this and the next three are empty for hidden checks
  std::string got{};
  std::string tolerance{};
  std::string input{};
  WorstValue worst{};
  int cases = 0;  ///< 0: the check has none
  int casesHeld = 0;
  std::string remark{};    ///< about the answers of a visible check that passed; usually empty
  std::string function{};  ///< the student's function that ran or answered last when it failed; empty: none
  int line = 0;  ///< in the student's file: where that happened, or where the function begins; 0: unknown
  double wallSeconds = 0;          ///< volatile
  double cpuSeconds = 0;           ///< volatile
  std::optional<Record> record{};  ///< volatile
  // Volatile, too. Files next to the results, which bulk grading may omit; empty: none.
  std::string picture{};  ///< shows what happened and what was wanted
  std::string replay{};   ///< the same as an animated page
};

struct CompileDiagnostic {
  std::string file{};
  int line = 0;
  int column = 0;
  std::string severity{};  ///< "error", "warning", "note"
  std::string rule{};      ///< "-Wreturn-type"
  std::string message{};
};

/// "main.cpp:47:3: error: message [rule]".
[[nodiscard]] std::string toString(const CompileDiagnostic& message);

struct CompileResult {
  int exitCode = 0;
  std::vector<CompileDiagnostic> diagnostics{};
  bool truncated = false;
};

/// Summed over the checks; memory is the largest of one worker.
struct Usage {
  double cpuSeconds = 0;
  double wallSeconds = 0;
  std::int64_t peakMemoryBytes = 0;
  std::uint64_t outputBytes = 0;
};

/// The part of the student's output that the result keeps.
struct KeptOutput {
  std::string text{};
  std::uint64_t truncatedBytes = 0;  ///< printed beyond it; volatile
};

struct GradeResult {
  std::string submissionId{};
  std::vector<SourceFile> files{};
  std::string snapshotSha256{};
  std::string exerciseId{};
  std::string exerciseVersion{};
  std::string seedId{};
  std::string toolVersion{};
  std::string compiler{};
  int sandboxLevel = 0;
  std::vector<std::string> sandboxWarnings{};
  Outcome outcome = Outcome::kGraderError;  ///< until the grading replaces it
  std::string message{};                    ///< about the submission as a whole
  int score = 0;
  int maxScore = 0;
  std::vector<CheckResult> checks{};
  CompileResult compile{};
  Limits limits{};
  KeptOutput output{};  ///< of visible checks
  KeptOutput error{};
  Usage usage{};  ///< volatile
};

/// Whether all checks but hidden ones were run: see Pass.
[[nodiscard]] bool awaitsHiddenChecks(const GradeResult& result);

/// The text of a result file. Invalid UTF-8 is replaced.
[[nodiscard]] std::string toJson(const GradeResult& result);

/// Reads it back; missing fields keep their defaults. Throws Error, naming `file` and the field, if the
/// text is not a result.
[[nodiscard]] GradeResult gradeResultFromJson(const std::string& text, const std::string& file);

/// Throws Error if the file cannot be read, and like gradeResultFromJson().
[[nodiscard]] GradeResult loadResult(const std::filesystem::path& file);

/// What a result was made with, besides the text and the grader.
struct GradedWith {
  sandbox::Level level{};
  std::optional<std::uint64_t> seed{};
  std::string secretId{};  ///< of the course; empty: none
  bool alone = false;      ///< by `rex grade --student`: the settings of the class do not count
};

/// What bulk grading keeps in a result file, as `inputs` and in `volatile`; empty where it does not say.
struct ResultInputs {
  std::string sha256{};              ///< of everything that the result depends on
  std::string sourceSha256{};        ///< of the student's file
  std::string seal{};                ///< see computeSeal()
  std::string hmac{};                ///< of the seal, with the secret of the course
  std::optional<GradedWith> with{};  ///< the settings
  bool evidence = false;             ///< pictures and replays were kept
};

/// What one reading of a result file gives.
struct ResultFile {
  std::optional<GradeResult> result{};  ///< empty: the text is none
  /// Why nobody should rely on its points: the text is no result, they do not add up, the outcome does not
  /// fit the checks, or it was changed since it was sealed (see computeSeal()). Empty: they can be relied on.
  std::string fault{};
  ResultInputs inputs{};
};
/// Empty if there is no such file. Throws Error if it cannot be read.
[[nodiscard]] std::optional<ResultFile> readResultFile(const std::filesystem::path& file);

/// The hash of all that counts in the text of a result: everything but `volatile` and `inputs`. Bulk grading
/// keeps it as `inputs.result_sha256`. Throws Error if the text is not JSON.
[[nodiscard]] std::string computeSeal(const std::string& text, const std::string& file);

/// Replaces the file atomically: a reader sees either the old text or the new one, even after a power cut.
/// Throws Error if that fails.
void saveResult(const GradeResult& result, const std::filesystem::path& file);

}  // namespace rex::grading
