#include "classroom/task_list.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/sha256.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/submission_folder.h"

namespace rex::classroom {
namespace {

constexpr const char* kHeadings =
    "task\tstudent\texercise\tsource_sha256\tgrader_sha256\tlevel\tseed\tsecret_id\tsubmitted\ttime_from\t"
    "inputs_sha256\tfile";
constexpr std::size_t kColumns = 12;

std::string seedText(const Task& task) { return task.seed ? fmt::format("{}", *task.seed) : ""; }

std::string line(const Task& task, std::size_t number) {
  if (task.file.string().find_first_of("\t\n\r") != std::string::npos)
    throw Error({.what = "the name of this file cannot be in a list of tasks",
                 .where = {task.file.string()},
                 .wanted = "no tab and no line break"});
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", number, task.student, task.exercise,
                     task.sourceSha256, task.graderSha256, numberOf(task.level), seedText(task),
                     task.secretId, task.submitted, task.timeFrom, task.inputsSha256(), task.file.string());
}

/// The fields of one line, with its position in the file.
class Line {
 public:
  Line(std::string_view text, std::string file, int number)
      : fields_(splitAt(text, '\t')), where_{std::move(file), number, 0} {
    if (fields_.size() != kColumns)
      refuse(fmt::format("{} columns", fields_.size()), fmt::format("{}", kColumns));
  }

  template <class Number>
  Number number(std::size_t column, const std::string& wanted) const {
    const std::optional<Number> value = parseNumber<Number>(fields_[column]);
    if (!value) refuse(fmt::format("'{}'", fields_[column]), wanted);
    return *value;
  }
  std::string text(std::size_t column) const { return std::string(fields_[column]); }

  [[noreturn]] void refuse(std::string found, std::string wanted) const {
    throw Error({.what = "not a list of tasks",
                 .where = where_,
                 .found = std::move(found),
                 .wanted = std::move(wanted)});
  }

 private:
  std::vector<std::string_view> fields_;
  SourceLocation where_;
};

// Names become folders, so the file is trusted no more than what a student hands in.
Task readTask(const Line& line, std::size_t number) {
  if (line.number<std::size_t>(0, "the number of the task") != number)
    line.refuse("task " + line.text(0), fmt::format("task {}", number));
  Task task{.student = line.text(1),
            .exercise = line.text(2),
            .sourceSha256 = line.text(3),
            .graderSha256 = line.text(4),
            .level = sandbox::parseLevel(line.number<int>(5, "a sandbox level")),
            .seed = {},
            .secretId = line.text(7),
            .submitted = line.number<std::int64_t>(8, "a time in seconds"),
            .timeFrom = line.text(9),
            .file = line.text(11)};
  if (!line.text(6).empty()) task.seed = line.number<std::uint64_t>(6, "a seed, or nothing");
  for (const std::string& name : {task.student, task.exercise})
    if (const std::string why = whyNoStudentName(name); !why.empty()) line.refuse(why, "a plain name");
  if (task.inputsSha256() != line.text(10)) line.refuse("another hash of the inputs", task.inputsSha256());
  return task;
}

}  // namespace

std::string Task::inputsSha256() const {
  return sha256(fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n", exercise, sourceSha256, graderSha256, numberOf(level),
                            seedText(*this), secretId));
}

std::string toManifest(const std::vector<Task>& tasks) {
  std::string text = fmt::format("{}\n", kHeadings);
  for (std::size_t k = 0; k < tasks.size(); ++k) text += line(tasks[k], k + 1);
  return text;
}

std::vector<Task> readManifest(const std::filesystem::path& file) {
  const std::string text = readTextFile(file);
  const std::vector<std::string_view> lines = splitLines(text);
  if (lines.empty() || lines[0] != kHeadings)
    throw Error({.what = "not a list of tasks",
                 .where = {file.string(), 1, 0},
                 .wanted = "the headings that `rex grade --manifest` writes"});
  std::vector<Task> tasks;
  for (std::size_t k = 1; k < lines.size(); ++k)
    tasks.push_back(readTask(Line(lines[k], file.string(), static_cast<int>(k) + 1), k));
  return tasks;
}

std::string numberRanges(std::vector<int> numbers) {
  std::sort(numbers.begin(), numbers.end());
  std::string text;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t last = k;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[k]);
    if (last > k) text += fmt::format("-{}", numbers[last]);
    k = last + 1;
  }
  return text;
}

}  // namespace rex::classroom
