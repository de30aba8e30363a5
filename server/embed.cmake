# Writes OUTPUT, which defines raytracer::embedded_files(): the bytes of FILES, a list with an entry
# "path=file" for each, separated by "|".
string(REPLACE "|" ";" files "${FILES}")
list(SORT files)
set(arrays "")
set(rows "")
set(index 0)
foreach(entry IN LISTS files)
  string(FIND "${entry}" "=" equals)
  string(SUBSTRING "${entry}" 0 ${equals} path)
  math(EXPR after "${equals} + 1")
  string(SUBSTRING "${entry}" ${after} -1 file)
  file(READ "${file}" hex HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
  # The trailing zero keeps the array of an empty file legal; it is not counted.
  string(APPEND arrays "const unsigned char file_${index}[] = {${bytes}0};\n")
  string(APPEND rows "    row(\"${path}\", file_${index}),\n")
  math(EXPR index "${index} + 1")
endforeach()
file(WRITE "${OUTPUT}.new" "#include \"server/embedded.h\"

#include <cstddef>

namespace raytracer {
namespace {

${arrays}
template <std::size_t size>
EmbeddedFile row(std::string_view path, const unsigned char (&bytes)[size]) {
  return {path, {reinterpret_cast<const char*>(bytes), size - 1}};
}

}  // namespace

std::span<const EmbeddedFile> embedded_files() {
  static const EmbeddedFile files[] = {
${rows}  };
  return files;
}

}  // namespace raytracer
")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
