#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/archive_samples.h"

namespace rex {

/// What a made-up student hands in.
enum class SyntheticWork { kHonest, kWrong, kBroken, kAttack, kMissing };

/// A student of a class that does not exist.
struct SyntheticStudent {
  std::string name{};   ///< some have umlauts, some in decomposed Unicode (NFD), some share theirs
  std::string id{};     ///< "3100007"
  std::string email{};  ///< "student7@uni.example"
  std::string user{};   ///< "octo-7"
  int number = 0;       ///< of the platform: 507
  SyntheticWork work{};
  int partner = -1;       ///< the other member of a pair; -1: alone
  bool isSecond = false;  ///< of a pair, the one who did not upload
  std::string text{};     ///< of main.cpp; a comment makes it unlike all others
  std::int64_t time = 0;  ///< of submission, full minutes, seconds since 1970 in UTC
};

/// The texts that they hand in.
struct SyntheticTexts {
  std::string honest{}, wrong{}, broken{};
};

/// A class of that many, the same each time. Of twelve in a row two share a name, two are a pair, one attacks
/// the reader of archives, one hands in nothing, and one is late: after 2026-11-20T22:59:00Z.
[[nodiscard]] std::vector<SyntheticStudent> syntheticClass(int count, const SyntheticTexts& texts);

/// The members of Moodle's zip. Students upload main.cpp, the same under another name, or a zip with a folder
/// of the exercise. `isFlat`: files instead of folders, as if the lecturer had chosen so.
[[nodiscard]] std::vector<SampleMember> moodleMembers(const std::vector<SyntheticStudent>& all,
                                                      const std::string& exercise, bool isFlat = false);

/// Moodle's grading worksheet, in English, or in German with its words for dates. Times are those of Berlin.
[[nodiscard]] std::string moodleWorksheet(const std::vector<SyntheticStudent>& all, bool isGerman = false);

/// The members of Gradescope's export, with the metadata. Pairs hand in once.
[[nodiscard]] std::vector<SampleMember> gradescopeMembers(const std::vector<SyntheticStudent>& all,
                                                          const std::string& exercise);

/// NAME/main.cpp, NAME.cpp and NAME.zip in turn. Names are those of addresses, which nobody shares.
[[nodiscard]] std::vector<SampleMember> folderMembers(const std::vector<SyntheticStudent>& all);

/// The roster and the record that go with a folder of clones, with the commit of each repository, or without
/// where `commits` is empty.
[[nodiscard]] std::string rosterOfClones(const std::vector<SyntheticStudent>& all);
[[nodiscard]] std::string recordOfClones(const std::vector<SyntheticStudent>& all,
                                         const std::vector<std::string>& commits);

/// "2026-11-20T22:58:00Z" and so on.
[[nodiscard]] std::string syntheticInstant(std::int64_t time);

}  // namespace rex
