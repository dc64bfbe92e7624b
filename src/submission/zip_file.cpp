#include "submission/zip_file.h"

#include <memory>

#include <archive.h>
#include <archive_entry.h>
#include <locale.h>

#include "base/error.h"
#include "base/text_file.h"

namespace rex::submission {
namespace {

/// Names are marked as UTF-8 in a thread whose locale has that encoding.
class Utf8Locale {
 public:
  Utf8Locale() : locale_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)), before_(::uselocale(locale_)) {}
  ~Utf8Locale() { ::uselocale(before_), ::freelocale(locale_); }
  Utf8Locale(const Utf8Locale&) = delete;
  Utf8Locale& operator=(const Utf8Locale&) = delete;

 private:
  locale_t locale_, before_;
};

la_ssize_t append(archive* /*zip*/, void* bytes, const void* more, std::size_t count) {
  static_cast<std::string*>(bytes)->append(static_cast<const char*>(more), count);
  return static_cast<la_ssize_t>(count);
}

// Without times, which makes the zip's the earliest one.
bool add(archive* zip, const ZipEntry& file) {
  const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(::archive_entry_new(),
                                                                       ::archive_entry_free);
  ::archive_entry_set_pathname(entry.get(), file.name.c_str());
  ::archive_entry_set_filetype(entry.get(), AE_IFREG);
  ::archive_entry_set_perm(entry.get(), 0644);
  const auto size = static_cast<la_ssize_t>(file.text.size());
  ::archive_entry_set_size(entry.get(), size);
  return ::archive_write_header(zip, entry.get()) == ARCHIVE_OK &&
         ::archive_write_data(zip, file.text.data(), file.text.size()) == size;
}

}  // namespace

void writeZip(const std::filesystem::path& file, const std::vector<ZipEntry>& entries) {
  const Utf8Locale locale;
  std::string bytes;
  const std::unique_ptr<archive, int (*)(archive*)> zip(::archive_write_new(), ::archive_write_free);
  bool isSound = ::archive_write_set_format_zip(zip.get()) == ARCHIVE_OK &&
                 ::archive_write_set_bytes_in_last_block(zip.get(), 1) == ARCHIVE_OK &&
                 ::archive_write_open(zip.get(), &bytes, nullptr, append, nullptr) == ARCHIVE_OK;
  for (const ZipEntry& entry : entries) isSound = isSound && add(zip.get(), entry);
  if (!isSound || ::archive_write_close(zip.get()) != ARCHIVE_OK) {
    const char* why = ::archive_error_string(zip.get());
    throw Error({.what = "cannot write the zip file",
                 .where = {.file = file.string()},
                 .found = why == nullptr ? "" : why});
  }
  replaceTextFile(file, bytes, "the zip file");
}

}  // namespace rex::submission
