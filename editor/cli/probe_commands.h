#pragma once

// `lararium-editor probe ...`: makes light probes from photographs, shows their content, and
// edits the probes of places (place_probe_commands.h).

#include <filesystem>
#include <glm/gtc/quaternion.hpp>

#include "editor/bake/probe_match.h"
#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/status.h"

namespace lararium::editor {

Result<CommandResult> RunProbe(const ProbeOptions& options);

// The orientation of a probe from the directions in `options.pairs`: either the direction of
// its sun on the stage, or one or two directions in the probe, each with the same on the stage.
// A single direction turns the probe from `stage_from_probe`, about the vertical only if
// `options.level`.
Result<bake::DirectionMatch> MatchProbe(const ProbeOptions& options,
                                        const std::filesystem::path& file,
                                        const glm::quat& stage_from_probe);

// The surface of `options.pixel` with its given properties.
Result<bake::GreyPatch> GreyPatchOf(const ProbeOptions& options);

}  // namespace lararium::editor
