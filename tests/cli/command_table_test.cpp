#include "cli/command_table.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/all_rooms.h"

namespace rex::cli::command_table_test {

constexpr Program kPrograms[] = {Program::kStudent, Program::kRobot, Program::kMethods, Program::kInstructor};

TEST(CommandTable, GivesEachProgramTheCommandsThatItRegisters) {
  for (const Program program : kPrograms) {
    const Room room = roomOf(program);
    EXPECT_EQ(room.program, program) << programName(program);
    std::vector<std::string_view> registered, given;
    for (const auto& [name, registration] : room.commands) registered.push_back(name);
    for (const TableEntry& entry : commandTable())
      if (entry.program == program) given.push_back(entry.name);
    EXPECT_THAT(registered, ::testing::UnorderedElementsAreArray(given)) << programName(program);
  }
}

TEST(CommandTable, NamesEachCommandOnceAndSaysWhatItIsFor) {
  std::set<std::string_view> names;
  for (const TableEntry& entry : commandTable()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_FALSE(entry.purpose.empty()) << entry.name;
    EXPECT_FALSE(entry.purpose.ends_with('.')) << entry.name;
  }
}

}  // namespace rex::cli::command_table_test
