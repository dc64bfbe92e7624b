#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rex::authoring {

/// One change in the regions of a solution.cpp, as a student's mistake could be.
struct Mutant {
  std::string change{};            ///< the kind: "sign", "x and y", "swapped arguments", ...
  std::string function{};          ///< the plain function that contains it
  int line = 0, column = 0;        ///< in solution.cpp, from 1
  std::string before{}, after{};   ///< the lines that it changes, in one, with single blanks
  std::size_t start = 0, end = 0;  ///< the characters that it replaces
  std::string replacement{};
};

/// The names of all kinds of changes.
[[nodiscard]] std::vector<std::string> kindsOfChanges();

/// The changes of every kind at every place of the regions, in the order of the text, without those outside
/// plain functions. The text must be formatted: blanks tell binary operators from other uses of their signs.
/// They need not compile. Throws Error like submission::solutionBlocks().
[[nodiscard]] std::vector<Mutant> mutantsOf(std::string_view solution, const std::string& file);

/// The same in all plain functions of a file without regions, but main().
[[nodiscard]] std::vector<Mutant> mutantsOfFile(std::string_view source);

/// The text with one of its mutants.
[[nodiscard]] std::string mutated(std::string_view solution, const Mutant& mutant);

/// The text with blanks in place of the marks of unnamed namespaces, so that other files may call what is in
/// them.
[[nodiscard]] std::string withoutUnnamedNamespaces(std::string_view source);

}  // namespace rex::authoring
