#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "sandbox/level.h"

namespace rex::cli {

/// What is wrong with a seed; nothing for one that thousands of others can follow.
std::string wrongSeed(const std::string& text);

/// `--seed S`. Refuses what is not a seed; CLI11 alone takes -1 for the largest number there is.
template <typename Seed>
CLI::Option* addSeed(CLI::App* command, Seed& seed, const std::string& help) {
  return command->add_option("--seed", seed, help)->check(wrongSeed)->type_name("S");
}

/// `--level N` of the sandbox.
CLI::Option* addLevel(CLI::App* command, std::optional<sandbox::Level>& level);

}  // namespace rex::cli
