#pragma once

// The shaders of shaders/, embedded at build time. Private to render.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/embedded_text.h"
#include "shared/core/status.h"

namespace lararium::render {

std::span<const EmbeddedText> ShaderSources();

// A shader as the compiler takes it: version line first, includes in place.
struct AssembledShader {
  std::string text;
  std::vector<std::string_view> files;  // by the source number that messages name

  // Replaces "number:line" or "number(line)" at the start of each line of a
  // compiler's log by the file's name and line.
  std::string ExplainLog(std::string_view log) const;
};

// header: goes first (version and precision). Each file is included once.
Result<AssembledShader> AssembleShader(std::string_view name, std::string_view header);
// For tests: from other sources.
Result<AssembledShader> AssembleShader(std::string_view name,
                                       std::string_view header,
                                       std::span<const EmbeddedText> sources);

}  // namespace lararium::render
