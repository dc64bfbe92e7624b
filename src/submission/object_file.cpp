#include "submission/object_file.h"

#include <bit>
#include <cstring>
#include <optional>
#include <type_traits>

#include <elf.h>
#include <fmt/format.h>

#include "base/error.h"

namespace rex::grading {
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

}  // namespace rex::grading
