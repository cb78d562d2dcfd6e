# Writes OUT, a source file that defines StdScripts() (std_scripts.h) with the
# text of each of SCRIPTS.
set(text "#include \"shared/drama/std_scripts.h\"\n\nnamespace lararium::drama {\n\n")
string(APPEND text "std::span<const StdScript> StdScripts() {\n  static constexpr StdScript kScripts[] = {\n")
foreach(script ${SCRIPTS})
  get_filename_component(name ${script} NAME)
  file(READ ${script} content)
  string(APPEND text "      {\"std/${name}\", R\"~~~(${content})~~~\"},\n")
endforeach()
string(APPEND text "  };\n  return kScripts;\n}\n\n}  // namespace lararium::drama\n")
file(WRITE ${OUT} "${text}")
