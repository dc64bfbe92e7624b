#include "grading/text_file.h"

#include <fstream>
#include <iterator>

#include "base/error.h"

namespace rex::grading {

std::string readTextFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file))
    throw Error({.what = "cannot read this file", .where = {file.string()}});
  return {std::istreambuf_iterator<char>(in), {}};
}

void writeTextFile(const std::filesystem::path& file, std::string_view text) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw Error({.what = "cannot write this file", .where = {file.string()}});
}

}  // namespace rex::grading
