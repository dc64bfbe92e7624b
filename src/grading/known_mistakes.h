#pragma once
// The mistakes of an exercise, known by what their functions answer in visible checks.
//   const KnownMistakes known = readKnownMistakes(readTextFile(file), file);
//   recognisedMistake(known, seen, "kf-step", "predicted")  // "Is Q left out?"
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grading/sketch.h"

namespace rex::grading {

/// What some mistakes answer in place of the right answer; nothing: they do not get that far.
struct WrongAnswer {
  std::vector<std::size_t> mistakes{};
  std::optional<Sketch> answer{};
};

/// A call whose right answer is known. Mistakes that no wrong answer names give the right one.
struct KnownCall {
  SketchedCall right{};
  std::vector<WrongAnswer> wrong{};
};

/// The file sketches.tsv of an exercise. It holds no code, no arguments and nothing of hidden checks.
struct KnownMistakes {
  std::vector<std::string> questions{};                    ///< of each mistake; empty: none is asked
  std::map<std::string, std::vector<KnownCall>> checks{};  ///< by id
};

/// What was heard in the visible checks of one program, by id.
using SketchedChecks = std::map<std::string, std::vector<SketchedCall>>;

/// A wrong program and the question about its mistake.
struct SketchedMistake {
  std::string question{};
  SketchedChecks checks{};
};

/// Keeps of each check and function those calls of the right program to which mistakes answer something else:
/// at most some for each mistake.
[[nodiscard]] KnownMistakes knownMistakes(const SketchedChecks& right,
                                          const std::vector<SketchedMistake>& mistakes);

/// The question about the one mistake that explains what the functions of a program answered in a check. The
/// function that is named is looked at first, then the others, as they were called. A mistake explains a
/// function if it gives all of its answers to known calls, at least one of them wrong. If several do, or if
/// the wrong answers are only whole numbers, so must it in the other checks. Empty if there is not one such
/// question.
[[nodiscard]] std::string recognisedMistake(const KnownMistakes& known, const SketchedChecks& seen,
                                            const std::string& check, const std::string& function);

[[nodiscard]] std::string toText(const KnownMistakes& known);
[[nodiscard]] std::string toText(const SketchedChecks& seen);

/// Read them back. Throw Error naming the line if the text is neither.
[[nodiscard]] KnownMistakes readKnownMistakes(std::string_view text, const std::string& file);
[[nodiscard]] SketchedChecks readSketchedChecks(std::string_view text, const std::string& file);

/// The first difference between two files that rounding does not explain: "check 'kf-step': other answers of
/// predicted"; empty if there is none.
[[nodiscard]] std::string differenceBetween(const KnownMistakes& a, const KnownMistakes& b);

}  // namespace rex::grading
