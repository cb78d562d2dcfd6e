#include "editor/cli/options.h"

#include <CLI/CLI.hpp>

#include "editor/cli/command_table.h"
#include "shared/core/utf8.h"

namespace lararium::editor {

void AddProject(CLI::App* command, std::filesystem::path& project) {
  command->add_option("PROJECT", project, "The project's folder")->required();
}

CLI::Option* RequireUtf8(CLI::Option* option) {
  return option->check([](const std::string& text) -> std::string {
    return IsUtf8(text) ? "" : "the text is not UTF-8; set the terminal's encoding to UTF-8";
  });
}

CLI::Option* AddText(CLI::App* command,
                     const std::string& name,
                     std::optional<std::string>& text,
                     const std::string& description) {
  return RequireUtf8(command->add_option_function<std::string>(
      name, [&](const std::string& given) { text = given; }, description));
}

void AddIntrinsics(CLI::App* command, std::vector<double>& intrinsics) {
  command->add_option("--intrinsics", intrinsics, "fx,fy,cx,cy[,k1,k2,p1,p2] in pixels")
      ->delimiter(',')
      ->expected(4, 8)
      ->check(CLI::Number);
}

void CheckIntrinsics(const std::vector<double>& intrinsics) {
  if (!intrinsics.empty() && intrinsics.size() != 4 && intrinsics.size() != 8) {
    throw CLI::ValidationError("--intrinsics", "takes 4 or 8 numbers");
  }
}

std::variant<CommandLine, int> ParseCommandLine(int argc, const char* const* argv) {
  constexpr int kUsageError = 2;
  CommandLine line;
  WindowOptions window;
  CLI::App app("Stages dramas with virtual people on real places.");
  app.set_version_flag("--version", LARARIUM_VERSION);
  app.require_subcommand(0, 1);
  app.add_flag("--json", line.json, "Print the result as one JSON object");
  app.add_option("PROJECT", window.project, "Project to open; the start page otherwise");
  CommandTable table(app, line);
  AddPlaceCommands(table);
  AddStageCommands(table);
  AddDramaCommands(table);
  AddShowCommands(table);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageError;
  }
  if (app.get_subcommands().empty()) {
    line.subcommand = window;
  }
  return line;
}

}  // namespace lararium::editor
