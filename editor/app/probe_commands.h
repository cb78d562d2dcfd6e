#pragma once

// `lararium-editor probe ...`: light probes from photographs, what is in them, and the probes of
// places (place_probe_commands.h).

#include <filesystem>
#include <glm/gtc/quaternion.hpp>

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "editor/bake/probe_match.h"
#include "shared/core/status.h"

namespace lararium::app {

Result<CommandResult> RunProbe(const ProbeOptions& options);

// How a probe lies by the directions that options.pairs names: that of its sun on the stage, or of
// one or two things in the probe and then on the stage. One turns it from stage_from_probe on,
// about the vertical alone where options.level says so.
Result<bake::DirectionMatch> MatchProbe(const ProbeOptions& options,
                                        const std::filesystem::path& file,
                                        const glm::quat& stage_from_probe);

// The surface of options.pixel and what is said of it.
Result<bake::GreyPatch> GreyPatchOf(const ProbeOptions& options);

}  // namespace lararium::app
