#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rex::sandbox {

/// Words for a system call, as a null-terminated list of pointers at a random address of at least 34 bits:
/// three of them cannot be guessed together. They stay until the process executes another program. Throws
/// Error if there is no memory.
[[nodiscard]] char* const* hiddenWords(const std::vector<std::string>& words);

/// The same for one word.
[[nodiscard]] const char* hiddenWord(const std::string& word);

}  // namespace rex::sandbox
