#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "grading/results.h"

namespace rex::authoring {

/// The file seen.txt of an exercise: what a student who makes the mistake of a wrong variant reads
/// first. Lines "NAME" and, indented, "CHECK: MESSAGE".
using SeenMessages = std::map<std::string, std::string>;

[[nodiscard]] std::filesystem::path seenMessagesFile(const std::filesystem::path& exercise);

/// The first failing check that has one of these ids, and its message: "CHECK: MESSAGE". Hidden checks count
/// if no visible one fails. For a submission that was not graded, the compiler's first error.
[[nodiscard]] std::string seenMessage(const grading::GradeResult& result,
                                      const std::vector<std::string>& ids);

/// Throws Error naming the line if a message has no variant.
[[nodiscard]] SeenMessages readSeenMessages(const std::filesystem::path& file);
void writeSeenMessages(const SeenMessages& messages, const std::filesystem::path& file);

/// The messages that differ from those of the file in more than their numbers, which compilers and machines
/// round in their own way, or that only one of both has. One line each; empty if there are none.
[[nodiscard]] std::vector<std::string> changedMessages(const SeenMessages& now, const SeenMessages& stored);

/// The messages in which got and wanted are printed alike, which explain nothing: "got 0.5 m, wanted at most
/// 0.5 m". One line each; empty if there are none.
[[nodiscard]] std::vector<std::string> messagesThatExplainNothing(const SeenMessages& messages);

}  // namespace rex::authoring
