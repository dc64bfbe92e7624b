#include "authoring/unpack.h"

#include <array>
#include <memory>

#include <archive.h>
#include <archive_entry.h>

#include "base/error.h"

namespace rex::grading {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::size_t kMostBytes = std::size_t{256} << 20;

// A signature and its offset in the file.
struct FileSign {
  std::size_t at;
  std::string_view bytes;
};
constexpr std::array<FileSign, 11> kFileSigns = {{{0, "PK\x03\x04"sv},
                                                  {0, "PK\x05\x06"sv},
                                                  {257, "ustar"sv},
                                                  {0, "\x1f\x8b"sv},
                                                  {0, "BZh"sv},
                                                  {0,
                                                   "\xfd"
                                                   "7zXZ\0"sv},
                                                  {0, "LZIP"sv},
                                                  {0, "\x28\xb5\x2f\xfd"sv},
                                                  {0, "7z\xbc\xaf\x27\x1c"sv},
                                                  {0, "070701"sv},
                                                  {0, "Rar!\x1a"sv}}};

struct FreeArchive {
  void operator()(archive* opened) const { ::archive_read_free(opened); }
};

Error refusal(const std::string& file, std::string found) {
  return Error({.what = "cannot look into this archive",
                .where = {file},
                .found = std::move(found),
                .wanted = "one that can be unpacked here, or none"});
}

Error broken(const std::string& file, archive* reader) {
  const char* said = ::archive_error_string(reader);
  return refusal(file, said == nullptr ? "corrupt data" : said);
}

void readData(archive* reader, const std::string& file, std::size_t& total, std::string& bytes) {
  std::array<char, 65536> buffer;
  for (;;) {
    const la_ssize_t count = ::archive_read_data(reader, buffer.data(), buffer.size());
    if (count == 0) return;
    if (count < 0) throw broken(file, reader);
    total += static_cast<std::size_t>(count);
    if (total > kMostBytes) throw refusal(file, "more than 256 MiB");
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

// Supports only those filters of libarchive that start no program.
void supportKnown(archive* reader) {
  ::archive_read_support_filter_gzip(reader);
  ::archive_read_support_filter_bzip2(reader);
  ::archive_read_support_filter_xz(reader);
  ::archive_read_support_filter_lzip(reader);
  ::archive_read_support_filter_zstd(reader);
  ::archive_read_support_format_zip(reader);
  ::archive_read_support_format_tar(reader);
  ::archive_read_support_format_7zip(reader);
  ::archive_read_support_format_cpio(reader);
  ::archive_read_support_format_rar(reader);
  ::archive_read_support_format_rar5(reader);
  ::archive_read_support_format_raw(reader);
}

}  // namespace

bool isPacked(std::string_view bytes) {
  for (const FileSign& sign : kFileSigns)
    if (bytes.size() > sign.at && bytes.substr(sign.at).starts_with(sign.bytes)) return true;
  return false;
}

std::vector<PackedFile> unpack(std::string_view bytes, const std::string& file) {
  const std::unique_ptr<archive, FreeArchive> reader(::archive_read_new());
  supportKnown(reader.get());
  if (::archive_read_open_memory(reader.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
    throw broken(file, reader.get());
  std::vector<PackedFile> files;
  archive_entry* entry = nullptr;
  std::size_t total = 0;
  for (;;) {
    const int end = ::archive_read_next_header(reader.get(), &entry);
    if (end == ARCHIVE_EOF) return files;
    if (end < ARCHIVE_WARN) throw broken(file, reader.get());
    const bool isRaw = ::archive_format(reader.get()) == ARCHIVE_FORMAT_RAW;
    // Nothing was unpacked then, and scanning would unpack the same bytes again and again.
    if (isRaw && ::archive_filter_count(reader.get()) < 2) throw refusal(file, "an unknown kind");
    if (::archive_entry_is_encrypted(entry) != 0) throw refusal(file, "an encrypted file");
    const char* name = ::archive_entry_pathname(entry);
    PackedFile& packed = files.emplace_back();
    if (!isRaw && name != nullptr) packed.name = name;
    readData(reader.get(), file, total, packed.bytes);
  }
}

}  // namespace rex::grading
