#pragma once

#include <string>
#include <string_view>

#include "base/error.h"

namespace rex {

/// What differs from what other programs make of a file because a reader left something out. Motion includes
/// masses and joints.
enum class Difference { kNone, kPicture, kContact, kMotion };

/// "", "the picture will differ", "contact will differ" or "motion will differ".
[[nodiscard]] constexpr std::string_view toString(Difference difference) {
  constexpr std::string_view kTexts[] = {"", "the picture will differ", "contact will differ",
                                         "motion will differ"};
  return kTexts[static_cast<int>(difference)];
}

/// What differs according to the message, which says it in these words.
[[nodiscard]] inline Difference differenceIn(const Diagnostic& note) {
  for (const Difference one : {Difference::kMotion, Difference::kContact, Difference::kPicture})
    if (note.message.find(toString(one)) != std::string::npos) return one;
  return Difference::kNone;
}

}  // namespace rex
