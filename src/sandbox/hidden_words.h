#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rex::sandbox {

/// Words for a system call, as a list of pointers that ends with a null pointer, at a random address of 34
/// bits: three of them cannot be guessed together. They stay until the process becomes another program.
/// Throws Error where there is no memory.
[[nodiscard]] char* const* hiddenWords(const std::vector<std::string>& words);

/// The same of one word.
[[nodiscard]] const char* hiddenWord(const std::string& word);

}  // namespace rex::sandbox
