#include "grading/hidden_seed.h"

#include <array>

#include <fmt/format.h>

#include "base/error.h"
#include "base/sha256.h"
#include "base/text.h"
#include "base/text_file.h"

namespace rex::grading {
namespace {

constexpr std::size_t kBlock = 64;  // bytes that SHA-256 processes at once

std::string mixed(std::string block, char with) {
  for (char& byte : block) byte = static_cast<char>(byte ^ with);
  return block;
}

}  // namespace

std::string hmacSha256(std::string_view key, std::string_view message) {
  std::string block = key.size() > kBlock ? bytesOfHex(sha256(key)) : std::string(key);
  block.resize(kBlock, '\0');
  const std::string inner = bytesOfHex(sha256(mixed(block, 0x36) + std::string(message)));
  return sha256(mixed(block, 0x5c) + inner);
}

std::uint64_t hiddenSeed(std::string_view secret, std::string_view submissionSha256,
                         std::string_view exercise, std::string_view group) {
  const std::string message = fmt::format("{}\n{}\n{}\n", submissionSha256, exercise, group);
  return parseNumber<std::uint64_t>(hmacSha256(secret, message).substr(0, 16), 16).value();
}

std::string readCourseSecret(const std::filesystem::path& file) {
  std::string secret = readTextFile(file);
  secret.erase(secret.find_last_not_of(" \t\r\n") + 1);
  constexpr std::size_t kShortest = 16;
  if (secret.size() < kShortest)
    throw Error({.what = "the secret of the course is too short",
                 .where = {file.string()},
                 .found = fmt::format("{} characters", secret.size()),
                 .wanted = fmt::format("at least {}", kShortest)});
  return secret;
}

std::string openSecretWarning(const std::filesystem::path& file) {
  using std::filesystem::perms;
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  const perms open = status.permissions() & (perms::group_read | perms::others_read);
  if (!std::filesystem::exists(status) || open == perms::none) return {};
  const char* whose = open == perms::group_read ? "members of its group" : "other users of this machine";
  return fmt::format("{}: {} may read the secret of the course; `chmod 600` ends that", file.string(), whose);
}

std::string courseSecretId(std::string_view secret) {
  return secret.empty() ? "" : sha256(secret).substr(0, 8);
}

}  // namespace rex::grading
