#pragma once

// The table of subcommands. Each is added by one call with its name, its description, and the
// function that declares its options. Only the command line parser includes this.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/cli/options.h"

namespace lararium::editor {

class CommandTable {
 public:
  // Both must outlive the table; the parser may outlive it.
  CommandTable(CLI::App& parser, CommandLine& line) : parser_(parser), line_(line) {}

  // Adds a subcommand. If it is named on the command line, its options become
  // `CommandLine::subcommand`. `check` throws CLI::ValidationError if the options contradict
  // each other.
  template <typename Options>
  void Add(const std::string& name,
           const std::string& description,
           void (*declare)(CLI::App* command, Options& options),
           void (*check)(const Options& options) = nullptr) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = parser_.add_subcommand(name, description);
    command->fallthrough();  // --json may stand anywhere.
    declare(command, *options);
    command->callback([options, check, &line = line_] {
      if (check != nullptr) {
        check(*options);
      }
      line.subcommand = *options;
    });
  }

 private:
  CLI::App& parser_;
  CommandLine& line_;
};

// Grouped by subject, in the order in which the help lists them.
void AddPlaceCommands(CommandTable& table);  // Projects, and the maps of places.
void AddStageCommands(CommandTable& table);  // Real objects on the stage: occluders, light.
void AddDramaCommands(CommandTable& table);  // People, their speech and their actions.
void AddShowCommands(CommandTable& table);   // Rendering, export and checks.

// Options that several subcommands share.
void AddProject(CLI::App* command, std::filesystem::path& project);
// Makes an option refuse text that is not UTF-8, as a terminal with another encoding gives it.
CLI::Option* RequireUtf8(CLI::Option* option);
// Adds an optional text that may be empty; CLI11 would treat an empty value as missing.
CLI::Option* AddText(CLI::App* command,
                     const std::string& name,
                     std::optional<std::string>& text,
                     const std::string& description);
void AddIntrinsics(CLI::App* command, std::vector<double>& intrinsics);
void CheckIntrinsics(const std::vector<double>& intrinsics);

}  // namespace lararium::editor
