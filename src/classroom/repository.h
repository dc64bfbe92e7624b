#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/folders.h"

namespace rex::classroom {

struct Commit {
  std::string id{};
  std::int64_t time = 0;  ///< by the committer's clock, seconds since 1970 in UTC
};

struct CommittedFile {
  std::string path{};
  std::string id{};      ///< of its content
  std::string whyNot{};  ///< why it cannot be read: "a symbolic link"
};

/// A student's clone, which is not trusted: its objects are read by git from a repository of ours, so that no
/// hook, filter, attribute, replacement or configuration of the clone is obeyed, and nothing is fetched.
class Repository {
 public:
  /// Throws Error if the folder holds no clone with objects of its own, or git is not installed.
  explicit Repository(const OpenedFolder& clone);

  /// The branch that is checked out, from its newest commit back; of merges the side that it was on. Empty if
  /// there is no commit. Throws Error if git cannot read it.
  [[nodiscard]] std::vector<Commit> history() const;

  /// The commit with that id, which may be cut to seven digits, if the clone has it.
  [[nodiscard]] std::optional<Commit> find(const std::string& id) const;

  /// Tags as Classroom 50 makes them, "2026-06-01T14-32-05Z-a1b2c3d" for one called submit/..., in their
  /// order, with what each names.
  [[nodiscard]] const std::map<std::string, std::string>& submitTags() const { return tags_; }

  /// Its files of that name, in any folder. Throws Error if git cannot read it.
  [[nodiscard]] std::vector<CommittedFile> filesNamed(const std::string& name, const Commit& commit) const;

  /// How many commits, from this one back on the side that history() takes, changed each file of that name,
  /// in any folder. Throws Error if git cannot read it.
  [[nodiscard]] std::map<std::string, int> changeCounts(const std::string& name, const Commit& commit) const;

  /// The contents of files, in their order; empty texts for those with a `whyNot`. Throws Error if git cannot
  /// read one.
  [[nodiscard]] std::vector<std::string> readContents(const std::vector<CommittedFile>& files) const;

 private:
  std::string git(const std::vector<std::string>& arguments, const std::string& input = {}) const;
  Error unreadable(const std::string& found) const;

  std::filesystem::path clone_;
  std::string head_;  ///< empty: no commit
  std::map<std::string, std::string> tags_{};
  std::unique_ptr<PrivateFolder> ours_;
};

}  // namespace rex::classroom
