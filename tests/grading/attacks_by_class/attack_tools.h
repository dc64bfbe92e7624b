// What several attacks begin with: the tables of loaded files (ELF), and a search of their symbols for the
// forbidden function. The battery puts this text where an attack includes it, for a submission is one file.
#include <cstdio>

#include "exercise.h"

namespace {
using Answer = double (*)(double);
struct Dyn {
  long tag;
  unsigned long value;
};
struct Sym {
  unsigned name;
  unsigned char info, other;
  unsigned short section;
  unsigned long value, size;
};
struct Map {
  unsigned long base;
  const char* name;
  Dyn* dynamic;
  Map* next;
  Map* previous;
};
struct Segment {
  unsigned type, flags;
  unsigned long offset, address, physical, in_file, in_memory, align;
};
struct Header {
  unsigned char magic[16];
  unsigned short type, machine;
  unsigned version;
  unsigned long entry, segments, sections;
  unsigned flags;
  unsigned short size, segment_size, segment_count, section_size, section_count, names;
};

bool same(const char* a, const char* b) {
  while (*a != 0 && *a == *b) {
    ++a;
    ++b;
  }
  return *a == *b;
}

/// The forbidden function in the tables of one loaded file; what else it holds of the library is printed.
Answer in_tables(unsigned long base, const Dyn* dynamic) {
  unsigned long symbols = 0, names = 0;
  for (; dynamic != nullptr && dynamic->tag != 0; ++dynamic) {
    unsigned long value = dynamic->value < base ? dynamic->value + base : dynamic->value;
    if (dynamic->tag == 6) symbols = value;
    if (dynamic->tag == 5) names = value;
  }
  if (symbols == 0 || names <= symbols) return nullptr;
  Answer found = nullptr;
  int printed = 0;
  for (auto* sym = reinterpret_cast<const Sym*>(symbols); reinterpret_cast<unsigned long>(sym + 1) <= names;
       ++sym) {
    if (sym->section == 0 || sym->value == 0) continue;
    const char* name = reinterpret_cast<const char*>(names + sym->name);
    if (name[0] == '_' && name[1] == 'Z' && name[2] == 'N' && name[3] == '3' && name[4] == 'r' &&
        name[5] == 'e' && name[6] == 'x' && printed++ < 20)
      std::printf("in memory: %s\n", name);
    if (same(name, "_ZN3rex6answerEd")) found = reinterpret_cast<Answer>(base + sym->value);
  }
  return found;
}
}  // namespace
