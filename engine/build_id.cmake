# Writes OUTPUT, which defines raytracer::build_id: twelve hex digits of a digest of SOURCE_DIR.
file(GLOB_RECURSE sources LIST_DIRECTORIES false RELATIVE ${SOURCE_DIR}
     ${SOURCE_DIR}/*.h ${SOURCE_DIR}/*.cpp)
list(SORT sources)
foreach(source IN LISTS sources)
  file(SHA256 ${SOURCE_DIR}/${source} digest)
  string(APPEND digests "${source} ${digest}\n")
endforeach()
string(SHA256 digest "${digests}")
string(SUBSTRING ${digest} 0 12 digest)
file(WRITE ${OUTPUT} "#include \"engine/build_id.h\"\n\nnamespace raytracer {\nconst char* const build_id = \"${digest}\";\n}  // namespace raytracer\n")
