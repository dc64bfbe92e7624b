#include "cli/robot/motion_log.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

std::string csvHead(const Model& model) {
  fmt::memory_buffer head;
  const auto out = std::back_inserter(head);
  fmt::format_to(out, "time");
  for (int i = 0; i < model.nq(); ++i) fmt::format_to(out, ",q{}", i);
  for (int i = 0; i < model.nv(); ++i) fmt::format_to(out, ",v{}", i);
  fmt::format_to(out, ",kinetic,potential,total\n");
  return fmt::to_string(head);
}

// The header has a fixed size, a multiple of 64 bytes, and gets the number of rows at the end.
std::string npyHead(long columns, long rows) {
  constexpr std::size_t kBefore = 10, kSize = 128;
  std::string words =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", rows, columns);
  words.resize(kSize - kBefore - 1, ' ');
  words += '\n';
  std::string head("\x93NUMPY\x01\x00", 8);
  head += static_cast<char>(words.size() & 0xff);
  head += static_cast<char>(words.size() >> 8);
  return head + words;
}

template <class Visit>
void forEachNumber(const Moment& moment, const Visit& visit) {
  visit(moment.state.time);
  for (const double x : moment.state.q) visit(x);
  for (const double x : moment.state.v) visit(x);
  visit(moment.energy.kinetic);
  visit(moment.energy.potential);
  visit(moment.energy.total());
}

// The topmost folder of a path that does not exist yet; empty if all exist.
fs::path firstNew(fs::path folder) {
  fs::path missing;
  for (std::error_code ignored; !folder.empty() && !fs::exists(folder, ignored);
       folder = folder.parent_path())
    missing = folder;
  return missing;
}

[[noreturn]] void failToWrite(const fs::path& file, const std::string& why) {
  throw Error({.what = "cannot write " + file.string(), .found = why});
}

}  // namespace

MotionLog::MotionLog(const fs::path& file, LogFormat format, const Model& model)
    : file_(file),
      part_(fs::path(file).concat(".part")),
      format_(format),
      columns_(model.nq() + model.nv() + 4) {
  firstNew_ = firstNew(file.parent_path());
  std::error_code problem;
  if (!file.parent_path().empty()) fs::create_directories(file.parent_path(), problem);
  if (problem) failToWrite(file, problem.message());
  out_.open(part_, std::ios::binary | std::ios::trunc);
  if (!out_) failToWrite(file, std::strerror(errno));
  write(format == LogFormat::kCsv ? csvHead(model) : npyHead(columns_, 0));
}

MotionLog::~MotionLog() {
  if (isFinished_) return;
  out_.close();
  std::error_code ignored;
  fs::remove(part_, ignored);
  if (firstNew_.empty()) return;
  for (fs::path folder = file_.parent_path(); fs::remove(folder, ignored) && folder != firstNew_;)
    folder = folder.parent_path();
}

void MotionLog::add(const Moment& moment) {
  std::string row;
  if (format_ == LogFormat::kCsv) {
    const auto out = std::back_inserter(row);
    forEachNumber(moment, [&](double x) { fmt::format_to(out, "{},", x); });
    row.back() = '\n';
  } else {
    static_assert(std::endian::native == std::endian::little);
    forEachNumber(moment, [&](double x) {
      const auto bytes = std::bit_cast<std::array<char, sizeof x>>(x);
      row.append(bytes.begin(), bytes.end());
    });
  }
  write(row);
  ++rows_;
}

void MotionLog::write(const std::string& bytes) {
  if (!out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    failToWrite(file_, std::strerror(errno));
}

void MotionLog::finish() {
  if (format_ == LogFormat::kNpy) {
    out_.seekp(0);
    write(npyHead(columns_, rows_));
  }
  out_.close();
  if (!out_) failToWrite(file_, std::strerror(errno));
  std::error_code problem;
  fs::rename(part_, file_, problem);
  if (problem) failToWrite(file_, problem.message());
  isFinished_ = true;
}

}  // namespace rex::cli
