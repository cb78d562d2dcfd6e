# cmake -DSHADER_DIR=... -DOUTPUT=... -P embed_shaders.cmake
# Writes a C++ source with all shaders as strings, so that programs need no files.
file(GLOB shaders RELATIVE ${SHADER_DIR} ${SHADER_DIR}/pass/*.vert ${SHADER_DIR}/pass/*.frag
     ${SHADER_DIR}/include/*.glsl)
list(SORT shaders)
set(entries "")
foreach(shader ${shaders})
  file(READ ${SHADER_DIR}/${shader} text)
  get_filename_component(name ${shader} NAME)
  string(APPEND entries "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"shared/render/shader_source.h\"

namespace lararium::render {
namespace {

constexpr ShaderSource kSources[] = {
${entries}};

}  // namespace

std::span<const ShaderSource> ShaderSources() { return kSources; }

}  // namespace lararium::render
")
