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

// A shader ready for the compiler: version line first, includes replaced by their text.
struct AssembledShader {
  std::string text;
  std::vector<std::string_view> files;  // index: source number in the compiler's messages

  // Replaces "number:line" or "number(line)" at the start of each line of a
  // compiler's log by the file's name and line.
  std::string ExplainLog(std::string_view log) const;
};

// header: text at the beginning (version and precision). Each file is included only once.
Result<AssembledShader> AssembleShader(std::string_view name, std::string_view header);
// For tests: assembles from other sources.
Result<AssembledShader> AssembleShader(std::string_view name,
                                       std::string_view header,
                                       std::span<const EmbeddedText> sources);

}  // namespace lararium::render
