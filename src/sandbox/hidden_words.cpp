#include "sandbox/hidden_words.h"

#include <cerrno>
#include <cstdint>
#include <cstring>

#include <sys/mman.h>
#include <sys/random.h>

#include "base/error.h"

namespace rex::sandbox {
namespace {

// The second is for machines with short addresses; the sanitizers keep all that is below it for themselves.
constexpr std::uint64_t kHighest[] = {std::uint64_t{1} << 46, std::uint64_t{1} << 38};
constexpr std::size_t kPage = 65536, kStep = 16;  // for all kinds of machines

// That many bytes at a random address, which may be anywhere within its page.
void* randomPlace(std::size_t size) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::uint64_t random = 0;
    if (::getrandom(&random, sizeof random, 0) != sizeof random) break;
    const std::uint64_t address = random % kHighest[attempt % 2] / kStep * kStep,
                        page = address / kPage * kPage;
    if (page == 0) continue;
    const std::size_t length = (address - page + size + kPage - 1) / kPage * kPage;
    void* place = ::mmap(reinterpret_cast<void*>(page), length, PROT_READ | PROT_WRITE,
                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
    if (place == MAP_FAILED) continue;
    if (place == reinterpret_cast<void*>(page)) return reinterpret_cast<void*>(address);
    ::munmap(place, length);
  }
  throw Error({.what = "no room in memory for the arguments of a program", .found = std::strerror(errno)});
}

}  // namespace

const char* hiddenWord(const std::string& word) {
  return static_cast<char*>(std::memcpy(randomPlace(word.size() + 1), word.c_str(), word.size() + 1));
}

char* const* hiddenWords(const std::vector<std::string>& words) {
  auto** list = static_cast<char**>(randomPlace((words.size() + 1) * sizeof(char*)));
  for (std::size_t k = 0; k < words.size(); ++k) list[k] = const_cast<char*>(hiddenWord(words[k]));
  list[words.size()] = nullptr;
  return list;
}

}  // namespace rex::sandbox
