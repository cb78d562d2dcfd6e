# cmake -DFILES=... -DNAMESPACE=... -DFUNCTION=... -DHEADER=... -DOUTPUT=... -P embed.cmake
# Writes a C++ source that defines NAMESPACE::FUNCTION() of HEADER: the texts of
# FILES in their order.
set(entries "")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND entries "    {\"${name}\", R\"~~~(${text})~~~\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

namespace ${NAMESPACE} {
namespace {

constexpr EmbeddedText kTexts[] = {
${entries}};

}  // namespace

std::span<const EmbeddedText> ${FUNCTION}() { return kTexts; }

}  // namespace ${NAMESPACE}
")
