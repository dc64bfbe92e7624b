#include "grading/result_file.h"

#include "base/text_file.h"

namespace rex::grading {

GradeResult loadResult(const std::filesystem::path& file) {
  return gradeResultFromJson(readTextFile(file), file.string());
}

void saveResult(const GradeResult& result, const std::filesystem::path& file) {
  replaceTextFile(file, toJson(result), "the result file");
}

}  // namespace rex::grading
