#include "submission/symbol_scan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <set>
#include <type_traits>

#include <cxxabi.h>
#include <elf.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/text_file.h"
#include "submission/cpp_names.h"
#include "submission/worker_part.h"

namespace rex::submission {
namespace {

constexpr unsigned char kByteOrder = std::endian::native == std::endian::little ? ELFDATA2LSB : ELFDATA2MSB;

class ObjectReader {
 public:
  ObjectReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  ObjectFile read() {
    readSections();
    readSymbols();
    readRelocations();
    ObjectFile object;
    for (std::size_t k = 1; k < headers_.size(); ++k)
      object.sections.push_back({.name = text(names_, headers_[k].sh_name),
                                 .type = headers_[k].sh_type,
                                 .ofEachThread = (headers_[k].sh_flags & SHF_TLS) ? headers_[k].sh_size : 0});
    for (ObjectSymbol& symbol : symbols_)
      if (!symbol.name.empty()) object.symbols.push_back(std::move(symbol));
    return object;
  }

 private:
  [[noreturn]] void refuse(std::string found, std::string wanted) const {
    throw Error({.what = "cannot read the compiled file",
                 .where = {file_},
                 .found = std::move(found),
                 .wanted = std::move(wanted)});
  }

  std::string_view part(std::uint64_t offset, std::uint64_t size) const {
    if (offset > bytes_.size() || size > bytes_.size() - offset)
      refuse(fmt::format("{} bytes from byte {}", size, offset),
             fmt::format("positions within its {} bytes", bytes_.size()));
    return bytes_.substr(offset, size);
  }

  template <class T>
  std::vector<T> table(std::uint64_t offset, std::uint64_t count) const {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count > bytes_.size() / sizeof(T))
      refuse(fmt::format("a table of {} entries", count), fmt::format("at most {} bytes", bytes_.size()));
    const std::string_view raw = part(offset, count * sizeof(T));
    std::vector<T> entries(count);
    if (count > 0) std::memcpy(entries.data(), raw.data(), raw.size());
    return entries;
  }

  template <class T>
  std::vector<T> tableIn(const Elf64_Shdr& section) const {
    if (section.sh_entsize != sizeof(T) || section.sh_size % sizeof(T) != 0)
      refuse(fmt::format("a table of {} bytes in entries of {}", section.sh_size, section.sh_entsize),
             fmt::format("entries of {} bytes", sizeof(T)));
    return table<T>(section.sh_offset, section.sh_size / sizeof(T));
  }

  const Elf64_Shdr& section(std::uint64_t index) const {
    if (index == 0 || index >= headers_.size())
      refuse(fmt::format("section {}", index), fmt::format("sections 1 to {}", headers_.size() - 1));
    return headers_[index];
  }

  std::string_view strings(const Elf64_Shdr& section) const {
    if (section.sh_type != SHT_STRTAB) refuse("names outside a string table", "one of type SHT_STRTAB");
    return part(section.sh_offset, section.sh_size);
  }

  std::string text(std::string_view strings, std::uint64_t offset) const {
    const std::size_t end = offset < strings.size() ? strings.find('\0', offset) : strings.npos;
    if (end == strings.npos)
      refuse(fmt::format("a name at byte {}", offset),
             fmt::format("names that end within the {} bytes of their table", strings.size()));
    return std::string(strings.substr(offset, end - offset));
  }

  void readSections() {
    const auto header = table<Elf64_Ehdr>(0, 1).front();
    const bool isObject = std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 &&
                          header.e_ident[EI_CLASS] == ELFCLASS64 && header.e_ident[EI_DATA] == kByteOrder &&
                          header.e_type == ET_REL && header.e_shentsize == sizeof(Elf64_Shdr);
    if (!isObject) refuse("another kind of file", "a relocatable 64-bit ELF file");
    // Counts that do not fit into the header are stored in section 0.
    const auto first = table<Elf64_Shdr>(header.e_shoff, 1).front();
    headers_ = table<Elf64_Shdr>(header.e_shoff, header.e_shnum != 0 ? header.e_shnum : first.sh_size);
    if (headers_.empty()) refuse("no sections", "a table of them");
    names_ = strings(section(header.e_shstrndx != SHN_XINDEX ? header.e_shstrndx : first.sh_link));
  }

  void readSymbols() {
    for (std::size_t k = 1; k < headers_.size(); ++k) {
      if (headers_[k].sh_type != SHT_SYMTAB) continue;
      if (symbolTable_) refuse("a second symbol table", "one");
      symbolTable_ = k;
    }
    if (!symbolTable_) refuse("no symbol table", "one");
    const Elf64_Shdr& header = headers_[*symbolTable_];
    const std::string_view names = strings(section(header.sh_link));
    for (const Elf64_Sym& entry : tableIn<Elf64_Sym>(header)) {
      const unsigned scope = ELF64_ST_BIND(entry.st_info);
      const bool isInSection =
          entry.st_shndx != SHN_UNDEF && entry.st_shndx < headers_.size() && entry.st_shndx < SHN_LORESERVE;
      const bool isFile = ELF64_ST_TYPE(entry.st_info) == STT_FILE;  // the name of a source
      symbols_.push_back({.name = isFile ? "" : text(names, entry.st_name),
                          .isDefined = entry.st_shndx != SHN_UNDEF,
                          .isGlobal = scope == STB_GLOBAL,
                          .isWeak = scope == STB_WEAK || scope == STB_GNU_UNIQUE,
                          .isShared = isInSection && (headers_[entry.st_shndx].sh_flags & SHF_GROUP) != 0});
    }
  }

  template <class Relocation>
  void markReferred(const Elf64_Shdr& section) {
    for (const Relocation& relocation : tableIn<Relocation>(section)) {
      const std::uint64_t symbol = ELF64_R_SYM(relocation.r_info);
      if (symbol >= symbols_.size())
        refuse(fmt::format("a relocation to symbol {}", symbol), fmt::format("{} symbols", symbols_.size()));
      symbols_[symbol].isReferred = true;
    }
  }

  void readRelocations() {
    for (const Elf64_Shdr& section : headers_) {
      if (section.sh_type != SHT_RELA && section.sh_type != SHT_REL) continue;
      if (section.sh_link != symbolTable_)
        refuse(fmt::format("relocations of the symbols in section {}", section.sh_link),
               fmt::format("those in section {}", *symbolTable_));
      section.sh_type == SHT_RELA ? markReferred<Elf64_Rela>(section) : markReferred<Elf64_Rel>(section);
    }
  }

  std::string_view bytes_;
  const std::string& file_;
  std::vector<Elf64_Shdr> headers_{};
  std::string_view names_{};
  std::optional<std::size_t> symbolTable_{};
  std::vector<ObjectSymbol> symbols_{};
};

}  // namespace

ObjectFile readObjectFile(std::string_view bytes, const std::string& file) {
  return ObjectReader(bytes, file).read();
}

namespace {

// Calls and tables of the loader, which find functions by name or by address while a program runs.
constexpr auto kLookups = std::to_array<const char*>({"dlsym",
                                                      "dlvsym",
                                                      "dlopen",
                                                      "dlmopen",
                                                      "dladdr",
                                                      "dladdr1",
                                                      "dlinfo",
                                                      "dl_iterate_phdr",
                                                      "_dl_sym",
                                                      "_dl_find_object",
                                                      "__libc_dlsym",
                                                      "__libc_dlopen_mode",
                                                      "_r_debug",
                                                      "_DYNAMIC",
                                                      "_GLOBAL_OFFSET_TABLE_",
                                                      "_rtld_global",
                                                      "_rtld_global_ro",
                                                      "__ehdr_start",
                                                      "__executable_start",
                                                      "getauxval",
                                                      "__getauxval"});

bool isLookup(std::string_view function) {
  return std::find(kLookups.begin(), kLookups.end(), function) != kLookups.end();
}

// "dlsym@GLIBC_2.2.5" is dlsym of one version.
std::string_view withoutVersion(std::string_view symbol) { return symbol.substr(0, symbol.find('@')); }

bool skip(std::string_view& text, std::string_view start) {
  if (!text.starts_with(start)) return false;
  text.remove_prefix(start.size());
  return true;
}

// A thunk enters a function for a pointer to another base: "Thn16_" or "Tv0_n24_" precedes its name.
void skipThunk(std::string_view& text) {
  const int offsets = skip(text, "Th") ? 1 : skip(text, "Tv") ? 2 : 0;
  for (int k = 0; k < offsets; ++k) text.remove_prefix(std::min(text.find('_'), text.size() - 1) + 1);
}

// Prefixes of a name: of a table, a guard or the name of a type, and "Z" for things inside functions.
void skipKind(std::string_view& text) {
  for (const char* kind : {"GV", "GR", "TV", "TT", "TI", "TS", "TH", "TW"})
    if (skip(text, kind)) break;
  skipThunk(text);
  while (skip(text, "Z")) {
  }
}

// "3rex5solve" for "rex::solve", and the number of names in it.
std::pair<std::string, int> mangled(std::string_view function) {
  std::string path;
  int count = 0;
  while (!function.empty()) {
    const std::string_view name = function.substr(0, function.find("::"));
    path += fmt::format("{}{}", name.size(), name);
    ++count;
    function.remove_prefix(std::min(name.size() + 2, function.size()));
  }
  return {path, count};
}

// Sections that the linker makes, and those that make it compile. In a student's file, both would be forged.
bool isOfLinker(const std::string& section) {
  constexpr auto kStarts = std::to_array<const char*>({".gnu.lto_", ".gnu.debuglto_", ".gnu.version", ".got",
                                                       ".plt", ".dyn", ".interp", ".hash", ".gnu.hash"});
  return std::any_of(kStarts.begin(), kStarts.end(),
                     [&](const char* start) { return section.starts_with(start); });
}

bool isForCompilers(unsigned type) {
  constexpr unsigned kUnwindTables = 0x70000001;  // SHT_X86_64_UNWIND
  constexpr auto kTypes = std::to_array<unsigned>(
      {SHT_NULL, SHT_PROGBITS, SHT_SYMTAB, SHT_STRTAB, SHT_RELA, SHT_REL, SHT_NOTE, SHT_NOBITS,
       SHT_INIT_ARRAY, SHT_FINI_ARRAY, SHT_PREINIT_ARRAY, SHT_GROUP, SHT_SYMTAB_SHNDX, kUnwindTables});
  return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

// A section such as ".rela.text" without the type of relocations would pass for one that the linker writes.
bool isPosingAsRelocations(const ObjectSection& section) {
  return section.name.starts_with(".rel") && !section.name.starts_with(".relro") &&
         section.type != SHT_RELA && section.type != SHT_REL;
}

bool isPlainName(const std::string& name) {
  const auto isPlain = [](char c) {
    return isWord(c) || c == '.' || c == '$' || c == '@' || c == '-' || static_cast<unsigned char>(c) >= 0x80;
  };
  return std::all_of(name.begin(), name.end(), isPlain) && printable(name, name.size()) == name;
}

// "rex::plot" for "rex::plot(std::string const&, rex::Figure const&)", as a person would call it.
std::string nameIn(const std::string& symbol) {
  const std::string text = demangled(symbol);
  std::string_view name = text;
  name.remove_prefix(std::min(name.find("rex::"), name.size()));
  return std::string(name.substr(0, name.find_first_of("(<[ ")));
}

grading::CompileDiagnostic forbiddenCall(const std::string& mainFile, std::pair<int, int> place,
                                         std::string message) {
  return {mainFile, place.first, place.second, "error", "forbidden-call", std::move(message)};
}

}  // namespace

std::string demangled(const std::string& symbol) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(
      abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), &std::free);
  return text ? text.get() : symbol;
}

bool isSymbolFor(std::string_view symbol, std::string_view function) {
  symbol = withoutVersion(symbol);
  if (symbol == function) return true;  // a name of the language C is not mangled
  if (!skip(symbol, "_Z")) return false;
  skipKind(symbol);
  const auto [path, count] = mangled(function);
  if (!skip(symbol, "N")) return count == 1 && symbol.starts_with(path);
  while (skip(symbol, "r") || skip(symbol, "V") || skip(symbol, "K") || skip(symbol, "R") ||
         skip(symbol, "O")) {
  }
  return symbol.starts_with(path);
}

std::vector<ForbiddenFunction> forbiddenCalls(const ObjectFile& object,
                                              const std::vector<ForbiddenFunction>& forbidden) {
  std::set<std::string_view> referred;
  for (const ObjectSymbol& symbol : object.symbols)
    if (symbol.isReferred) referred.insert(symbol.name);
  std::vector<ForbiddenFunction> found;
  for (const ForbiddenFunction& one : forbidden)
    if (std::any_of(referred.begin(), referred.end(),
                    [&](std::string_view symbol) { return isSymbolFor(symbol, one.function); }))
      found.push_back(one);
  std::set<std::string_view> lookups;
  for (const std::string_view symbol : referred)
    if (isLookup(withoutVersion(symbol))) lookups.insert(withoutVersion(symbol));
  for (const std::string_view name : lookups)
    found.push_back({std::string(name), "it looks up functions at run time"});
  return found;
}

std::vector<grading::CompileDiagnostic> strangeParts(const ObjectFile& object, const std::string& mainFile) {
  constexpr std::size_t kShown = 60;
  std::vector<grading::CompileDiagnostic> messages;
  const auto complain = [&](const char* text, const std::string& name) {
    if (messages.size() < 4)  // further ones add nothing
      messages.push_back(
          forbiddenCall(mainFile, {}, fmt::format(fmt::runtime(text), printable(name, kShown))));
  };
  for (const ObjectSymbol& symbol : object.symbols)
    if (!isPlainName(symbol.name))
      complain("names something '{}', wanted letters, digits and underscores", symbol.name);
  for (const ObjectSection& section : object.sections) {
    if (!isPlainName(section.name))
      complain("names a section '{}', wanted letters, digits, points and underscores", section.name);
    if (isOfLinker(section.name) || !isForCompilers(section.type) || isPosingAsRelocations(section))
      complain("makes a section '{}', which only the linker may make", section.name);
    // Some linkers would make a program of it that no machine can start.
    constexpr std::size_t kMostOfEachThread = 64u << 20;
    if (section.ofEachThread > kMostOfEachThread)
      complain("keeps more than 64 MiB for each thread in section '{}'", section.name);
  }
  return messages;
}

std::vector<std::string> callsNotOffered(const ObjectFile& object, const std::vector<std::string>& offers) {
  std::set<std::string> found;
  for (const ObjectSymbol& symbol : object.symbols)
    if (symbol.isReferred && !symbol.isDefined && isSymbolFor(symbol.name, "rex") &&
        !std::binary_search(offers.begin(), offers.end(), symbol.name))
      found.insert(nameIn(symbol.name));
  return {found.begin(), found.end()};
}

std::vector<grading::CompileDiagnostic> scanSymbols(const std::filesystem::path& object,
                                                    std::string_view source, const std::string& mainFile,
                                                    const std::vector<ForbiddenFunction>& forbidden,
                                                    const std::filesystem::path& offers) {
  const ObjectFile file = readObjectFile(readTextFile(object), object.string());
  const CppText text(source);
  std::vector<grading::CompileDiagnostic> messages;
  const auto complain = [&](const std::string& function, std::string message) {
    if (messages.size() <= kMostMessages)
      messages.push_back(forbiddenCall(mainFile, onlyMention(function, text), std::move(message)));
  };
  for (const ForbiddenFunction& call : forbiddenCalls(file, forbidden)) {
    const char* form = isLookup(call.function) ? "calls {}, which nobody may call in this exercise: {}"
                                               : "calls {}, which only main() may call in this exercise: {}. "
                                                 "Write it yourself instead";
    complain(call.function, fmt::format(fmt::runtime(form), call.function, call.reason));
  }
  if (offers.empty()) return messages;
  for (const std::string& function : callsNotOffered(file, offeredSymbols(offers))) {
    const auto isOf = [&](const ForbiddenFunction& one) {
      return function == one.function || function.starts_with(one.function + "::");
    };
    if (std::none_of(forbidden.begin(), forbidden.end(), isOf))
      complain(function, fmt::format("calls {}, which only main() may call in this exercise: 'allowed' in "
                                     "exercise.toml lists what graded functions may call",
                                     function));
  }
  return messages;
}

}  // namespace rex::submission
