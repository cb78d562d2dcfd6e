#pragma once

// The subcommands of the editor, each entered by one line: its name, what it is for, and the
// function that says which options it takes. Only the parser of the command line includes this.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/options.h"

namespace lararium::app {

class CommandTable {
 public:
  // Both outlive the table; the parser may outlive it.
  CommandTable(CLI::App& parser, CommandLine& line) : parser_(parser), line_(line) {}

  // Where the subcommand is named, its options become those of the line. check: throws
  // CLI::ValidationError where they do not go together.
  template <typename Options>
  void Add(const std::string& name,
           const std::string& description,
           void (*declare)(CLI::App* command, Options& options),
           void (*check)(const Options& options) = nullptr) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = parser_.add_subcommand(name, description);
    command->fallthrough();  // --json may stand anywhere
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

// By subject, in the order in which the help lists them.
void AddPlaceCommands(CommandTable& table);  // projects, and the maps of places
void AddStageCommands(CommandTable& table);  // what is real on the stage: occluders, light
void AddDramaCommands(CommandTable& table);  // people and what they say and do
void AddShowCommands(CommandTable& table);   // from the project to what is seen

// What several of them take.
void AddProject(CLI::App* command, std::filesystem::path& project);
// A text that may be empty, which CLI11 takes for none where the value is optional.
CLI::Option* AddText(CLI::App* command,
                     const std::string& name,
                     std::optional<std::string>& text,
                     const std::string& description);
void AddIntrinsics(CLI::App* command, std::vector<double>& intrinsics);
void CheckIntrinsics(const std::vector<double>& intrinsics);

}  // namespace lararium::app
